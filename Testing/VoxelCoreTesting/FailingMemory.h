#pragma once
// Memory that runs out within parallel loops. Replaces operator new: for one source of a test program, compiled by
// itself.

#include <gtest/gtest.h>

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <functional>
#include <new>
#include <string>
#include <utility>
#include <vector>

// The operators of clang's sanitizers cannot be replaced.
#if !defined(VOXELCORE_SANITIZED) || !defined(__clang__)
#  define VOXELCORE_FAILING_MEMORY

namespace
{

// Of what is asked for within parallel loops.
std::atomic<long> s_Asked{ 0 };
std::atomic<long> s_Failing{ 0 }; ///< which one finds no memory, from 1; 0: none

void *
Take(void * (*allocate)(std::size_t, std::size_t), std::size_t size, std::size_t alignment)
{
  const bool fails = omp_get_level() > 0 && ++s_Asked == s_Failing;
  void *     memory = fails ? nullptr : allocate(size, alignment);
  if (memory == nullptr)
  {
    throw std::bad_alloc();
  }
  return memory;
}

} // namespace

void *
operator new(std::size_t size)
{
  return Take([](std::size_t bytes, std::size_t) { return std::malloc(std::max<std::size_t>(bytes, 1)); }, size, 1);
}

void *
operator new(std::size_t size, std::align_val_t alignment)
{
  const auto whole = [](std::size_t bytes, std::size_t unit) {
    return std::aligned_alloc(unit, (std::max<std::size_t>(bytes, 1) + unit - 1) / unit * unit);
  };
  return Take(whole, size, static_cast<std::size_t>(alignment));
}

// Those that do not throw: std::stable_sort() has its buffers from them. A sanitizer has its own, whose memory is not
// for free().
void *
operator new(std::size_t size, const std::nothrow_t &) noexcept
{
  try
  {
    return operator new(size);
  }
  catch (const std::bad_alloc &)
  {
    return nullptr;
  }
}

void *
operator new(std::size_t size, std::align_val_t alignment, const std::nothrow_t &) noexcept
{
  try
  {
    return operator new(size, alignment);
  }
  catch (const std::bad_alloc &)
  {
    return nullptr;
  }
}

// Where one is inlined and its counterpart is not, GCC takes them for two that do not belong together.
[[gnu::noinline]] void
operator delete(void * memory) noexcept
{
  std::free(memory);
}

[[gnu::noinline]] void
operator delete(void * memory, std::size_t) noexcept
{
  std::free(memory);
}

[[gnu::noinline]] void
operator delete(void * memory, std::align_val_t) noexcept
{
  std::free(memory);
}

[[gnu::noinline]] void
operator delete(void * memory, std::size_t, std::align_val_t) noexcept
{
  std::free(memory);
}

[[gnu::noinline]] void
operator delete(void * memory, const std::nothrow_t &) noexcept
{
  std::free(memory);
}

[[gnu::noinline]] void
operator delete(void * memory, std::align_val_t, const std::nothrow_t &) noexcept
{
  std::free(memory);
}

namespace voxelcore::testing
{

/** Each work, by name, allocates within a parallel loop, and throws on that there is no memory. */
inline void
ExpectLackOfMemoryIsThrownOn(const std::vector<std::pair<std::string, std::function<void()>>> & works)
{
  for (const auto & [name, work] : works)
  {
    s_Asked = 0;
    work();
    const long all = s_Asked;
    EXPECT_GT(all, 0) << name;
    for (const long failing : { 1L, 2L, all / 2 })
    {
      s_Asked = 0;
      s_Failing = std::clamp(failing, 1L, all);
      EXPECT_THROW(work(), std::bad_alloc) << name << " " << failing << " of " << all;
      s_Failing = 0;
    }
    work(); // nothing is left behind
  }
}

} // namespace voxelcore::testing

#endif
