// The same core, pruned or not, whatever the number of threads and wherever the volume begins and ends.

#include "VoxelCoreTesting/Cores.h"
#include "VoxelCoreTesting/Threads.h"

#include "voxelcore/Phantom/Phantom.h"
#include "voxelcore/VoxelCore/LambdaPruning.h"
#include "voxelcore/VoxelCore/TolerancePruning.h"

#include <algorithm>
#include <cmath>
#include <iostream>

namespace voxelcore
{
namespace
{

using testing::Size3;
using testing::Spacing3;

/** Whole, pruned by lambda, and pruned by tolerance. */
std::vector<MedialComplex>
AllResults(const VoxelShape & shape, const Spacing3 & spacing)
{
  const double               smallest = *std::min_element(spacing.begin(), spacing.end());
  const MedialComplex        core = testing::CoreWithTolerancesOf(shape, spacing);
  std::vector<MedialComplex> results = PruneByLambda(core, { 0, 1.5 * smallest });
  results.push_back(PruneByTolerance(core, 1.2 * std::sqrt(3) * smallest));
  return results;
}

void
ExpectSameWithAnyNumberOfThreads(const VoxelShape & shape, const Spacing3 & spacing)
{
  const auto with = [&](int count) {
    const testing::Threads threads(count);
    return AllResults(shape, spacing);
  };
  const auto alone = with(1);
  for (const int threads : { 2, 3, 7 })
  {
    SCOPED_TRACE(threads);
    const auto others = with(threads);
    for (std::size_t i = 0; i < alone.size(); ++i)
    {
      ASSERT_NO_FATAL_FAILURE(testing::ExpectSameCore(others[i], alone[i]));
    }
  }
}

TEST(Reproducible, WithAnyNumberOfThreadsOnEveryPhantom)
{
  for (const PhantomKind & kind : PhantomKinds())
  {
    SCOPED_TRACE(kind.name);
    PhantomOptions options;
    options.kind = kind.name;
    const std::int32_t side = kind.name == "root" ? 96 : kind.name == "noise" || kind.name == "porous" ? 24 : 48;
    options.size = { side, side, side };
    const VoxelShape shape = MakePhantom(options);
    ASSERT_NO_FATAL_FAILURE(ExpectSameWithAnyNumberOfThreads(shape, { 1, 1, 1 }));
    ASSERT_NO_FATAL_FAILURE(ExpectSameWithAnyNumberOfThreads(shape, { 1, 1, 2.5 }));
  }
}

/** The shape in a box that is larger by `below` and `above`. */
VoxelShape
Padded(const VoxelShape & shape, const Size3 & below, const Size3 & above)
{
  VoxelBox box = shape.Box();
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    box.lower[axis] -= below[axis];
    box.size[axis] += below[axis] + above[axis];
  }
  VoxelShape padded(box);
  const auto & [lower, size] = shape.Box();
  for (std::int32_t z = lower[2]; z < lower[2] + size[2]; ++z)
  {
    for (std::int32_t y = lower[1]; y < lower[1] + size[1]; ++y)
    {
      for (std::int32_t x = lower[0]; x < lower[0] + size[0]; ++x)
      {
        if (shape.Contains(x, y, z))
        {
          padded.Insert(x, y, z);
        }
      }
    }
  }
  return padded;
}

// The lattice engine works brick by brick from the corner of the box: bricks of other places, and so of other extents.
TEST(Reproducible, WhenTheVolumeIsPadded)
{
  std::cout << "seeds from 41000\n";
  for (std::uint64_t seed = 41000; seed < 41010; ++seed)
  {
    testing::Random  random(seed);
    const VoxelShape shape = seed % 2 == 0 ? testing::RandomShape(random, { 40, 20, 20 }, 0.5)
                                           : testing::Ellipsoid(30 + static_cast<std::int32_t>(seed - 41000) * 3);
    const auto       side = [&] { return static_cast<std::int32_t>(random.Between(0, 40)); };
    const Size3      below{ side(), side(), side() };
    const Size3      above{ side(), side(), side() };
    const Spacing3 & spacing = testing::TestSpacings()[seed % 6];
    const auto       a = AllResults(shape, spacing);
    const auto       b = AllResults(Padded(shape, below, above), spacing);
    SCOPED_TRACE(seed);
    for (std::size_t i = 0; i < a.size(); ++i)
    {
      SCOPED_TRACE(i);
      ASSERT_NO_FATAL_FAILURE(testing::ExpectSameCore(a[i], b[i]));
    }
  }
}

// Cut out of its volume and counted from its own corner, as --crop and other programs do.
TEST(Reproducible, WhenTheVolumeIsCropped)
{
  std::cout << "seeds from 42000\n";
  for (std::uint64_t seed = 42000; seed < 42010; ++seed)
  {
    SCOPED_TRACE(seed);
    testing::Random  random(seed);
    const VoxelShape shape = seed % 2 == 0 ? testing::RandomShape(random, { 30, 20, 20 }, 0.6) : testing::Ellipsoid(36);
    const auto       step = [&] { return static_cast<std::int32_t>(random.Between(1, 2000)); };
    const Size3      shift{ step(), step(), step() };
    const VoxelShape moved = testing::ShapeWhere(
      shape.Box().size,
      [&](int x, int y, int z) { return shape.Contains(x, y, z); },
      shift);
    const Spacing3 & spacing = testing::TestSpacings()[seed % 6];
    const auto       a = AllResults(shape, spacing);
    const auto       b = AllResults(moved, spacing);
    for (std::size_t i = 0; i < a.size(); ++i)
    {
      SCOPED_TRACE(i);
      ASSERT_NO_FATAL_FAILURE(testing::ExpectSameCore(a[i], b[i], false));
      for (std::size_t vertex = 0; vertex < a[i].positions.size(); ++vertex)
      {
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          // Each is the exact place rounded once, so they differ by no more than both roundings and that of the sum.
          const double there = b[i].positions[vertex][axis];
          const double here = a[i].positions[vertex][axis] + shift[axis];
          ASSERT_LE(std::abs(there - here), 2 * (std::nextafter(there, 1e300) - there));
        }
      }
    }
  }
}

} // namespace
} // namespace voxelcore
