// Memory that runs out within a parallel loop: an exception that left its thread would end the program, so each loop
// that allocates keeps it and throws it on.

#include "VoxelCoreTesting/Shapes.h"
#include "VoxelCoreTesting/Threads.h"

#include "voxelcore/BallUnion.h"
#include "voxelcore/EightLanes.h"
#include "voxelcore/GreyLevels.h"
#include "voxelcore/ShapeClosing.h"
#include "voxelcore/ShapeDenoising.h"
#include "voxelcore/ShapeEdits.h"
#include "voxelcore/ShapeMedian.h"
#include "voxelcore/ShapeSmoothing.h"
#include "voxelcore/SliceHoles.h"

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
namespace
{

TEST(LackOfMemory, WithinAParallelLoopIsThrownOn)
{
  const Threads    scope(3);
  Random           random(7);
  const VoxelShape noise = RandomShape(random, { 70, 40, 40 }, 0.4);
  const auto       isInShell = [](int x, int y, int z, int at) {
    const int squared = (x - 20) * (x - 20) + (y - 20) * (y - 20) + (z - at) * (z - at);
    return squared > 100 && squared < 200;
  };
  std::vector<EditedLabel> hollow(2);
  for (int i = 0; i < 2; ++i)
  {
    EditedLabel & label = hollow[static_cast<std::size_t>(i)];
    label.label.value = i + 1;
    label.label.shape =
      ShapeWhere({ 40, 40, 80 }, [&](int x, int y, int z) { return isInShell(x, y, z, 20 + 40 * i); });
    label.label.voxels = label.label.shape.CountVoxels();
  }
  const std::vector<std::array<double, 3>> centres{ { 20, 20, 10 }, { 20, 20, 50 } };
  const std::vector<double>                radius{ 9, 9 };
  BandValues                               values{ VoxelShape(noise) };
  for (std::int32_t z = 0; z < 40; ++z)
  {
    for (std::int32_t y = 0; y < 40; ++y)
    {
      std::vector<float> row(70);
      std::generate(row.begin(), row.end(), [&] { return static_cast<float>(random.Between(0, 99)); });
      values.SetRow(y, z, row);
    }
  }
  VoxelShape bright(noise.Box());
  for (std::int32_t z = 0; z < 40; ++z)
  {
    for (std::int32_t y = 0; y < 40; ++y)
    {
      for (std::int32_t x = 0; x < 70; ++x)
      {
        if (noise.Contains(x, y, z) && values.At(x, y, z) >= 50)
        {
          bright.Insert(x, y, z);
        }
      }
    }
  }
  const LatticeBall                                                ball{ { 1, 1, 1 }, 9 };
  const std::vector<std::pair<std::string, std::function<void()>>> works{
    { "median", [&] { MedianShape(noise, { 3 }); } },
    { "denoise",
      [&] {
        DenoiseShape(noise, { 1, 1, 1 });
      } },
    { "mend", [&] { MendShape(noise); } },
    { "smooth", [&] { SmoothShape(noise); } },
    { "close", [&] { CloseShape(noise, ball); } },
    { "fill hollows", [&] { FillHollows(hollow[0].label.shape, ball); } },
    { "slices across x", [&] { FillSlices(noise, SliceAxis::I); } },
    { "slices across y", [&] { FillSlices(noise, SliceAxis::J); } },
    { "balls",
      [&] {
        UnionOfBalls(VoxelBox{ { 0, 0, 0 }, { 40, 40, 64 } }, { 1, 1, 1 }, centres, radius);
      } },
    { "hollow labels",
      [&] {
        FindHollowLabels(hollow, { 1, 1, 1 });
      } },
    { "levels", [&] { ProposeLevels(bright, values, 50); } },
  };
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

} // namespace
} // namespace voxelcore::testing

#endif
