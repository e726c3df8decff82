// Large arrays in large pages, and given back at once; small ones kept for the next.
//
// The arrays of a core are read out of order, and with pages of 4 kB a good part of that time goes into finding pages.
// Where the system gives large pages on request only (Debian's default), this asks for them. Programs decide that, not
// libraries, so that this stands here.

#include "voxelcore/Base/EightLanes.h"

#include <cstdint>
#include <cstdlib>
#include <new>

#include <malloc.h>
#include <sys/mman.h>

// The operators of clang's sanitizers cannot be replaced.
#if !defined(VOXELCORE_SANITIZED) || !defined(__clang__)

namespace
{

constexpr std::size_t    largePage = std::size_t{ 2 } << 20;
constexpr std::size_t    worthIt = 2 * largePage;
constexpr std::uintptr_t insidePage = largePage - 1;

// Left to itself, malloc() learns from arrays of up to 32 MB that it should keep such memory for later. Smaller ones it
// should keep: many labels ask for the same again and again, and each first touch of a page is a call of the system.
[[maybe_unused]] const int isThresholdSet = mallopt(M_MMAP_THRESHOLD, largePage);
[[maybe_unused]] const int isTrimSet = mallopt(M_TRIM_THRESHOLD, worthIt);

void
AskForLargePages(void * memory, std::size_t size)
{
  // Whole pages within the array: what is never touched costs nothing, and neighbours are left alone.
  const auto           begin = reinterpret_cast<std::uintptr_t>(memory);
  const std::uintptr_t first = (begin + insidePage) & ~insidePage;
  const std::uintptr_t end = (begin + size) & ~insidePage;
  if (first < end)
  {
    // A wish only: where it is not granted, all goes on as before.
    madvise(static_cast<char *>(memory) + (first - begin), end - first, MADV_HUGEPAGE);
  }
}

// aligned_alloc() asks for sizes that are a multiple of the alignment.
void *
InLargePages(std::size_t size)
{
  void * memory = nullptr;
  return posix_memalign(&memory, largePage, size) == 0 ? memory : nullptr;
}

// What operator new does, with memory from `allocate`.
template <typename TAllocate>
void *
Allocate(std::size_t size, const TAllocate & allocate)
{
  for (;;)
  {
    void * const memory = allocate();
    if (memory != nullptr)
    {
      if (size >= worthIt)
      {
        AskForLargePages(memory, size);
      }
      return memory;
    }
    const std::new_handler handler = std::get_new_handler();
    if (handler == nullptr)
    {
      throw std::bad_alloc();
    }
    handler();
  }
}

} // namespace

// The standard's replaceable functions; the matching operator delete calls free().
void *
operator new(std::size_t size)
{
  return Allocate(size, [size] { return size >= worthIt ? InLargePages(size) : std::malloc(size == 0 ? 1 : size); });
}

void *
operator new(std::size_t size, std::align_val_t alignment)
{
  const auto        unit = static_cast<std::size_t>(alignment);
  const std::size_t whole = (size == 0 ? unit : size + unit - 1) / unit * unit; // as aligned_alloc() asks
  return Allocate(size, [unit, whole] { return std::aligned_alloc(unit, whole); });
}

// Those that do not throw: std::inplace_merge() has its buffers from them. A sanitizer has its own, whose memory is not
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

void
operator delete(void * memory) noexcept
{
  std::free(memory);
}

void
operator delete(void * memory, std::size_t) noexcept
{
  std::free(memory);
}

void
operator delete(void * memory, std::align_val_t) noexcept
{
  std::free(memory);
}

void
operator delete(void * memory, std::size_t, std::align_val_t) noexcept
{
  std::free(memory);
}

void
operator delete(void * memory, const std::nothrow_t &) noexcept
{
  std::free(memory);
}

void
operator delete(void * memory, std::align_val_t, const std::nothrow_t &) noexcept
{
  std::free(memory);
}

#endif
