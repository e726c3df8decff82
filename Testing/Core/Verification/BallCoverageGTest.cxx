#include "voxelcore/Verification/BallCoverage.h"

#include "VoxelCoreTesting/BruteShape.h"
#include "VoxelCoreTesting/Cores.h"
#include "VoxelCoreTesting/Threads.h"

#include "voxelcore/VoxelCore/TolerancePruning.h"
#include "voxelcore/VoxelCore/ToleranceWeights.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>

namespace voxelcore
{
namespace
{

/** Every boundary vertex, found by its eight voxels, against every ball; weighed by what the makers of cores say. */
BoundaryGap
GapByLookingAtAll(const VoxelShape &                         shape,
                  const SpacingWeights &                     weights,
                  const std::vector<std::array<double, 3>> & positions,
                  const std::vector<double> &                radius,
                  bool                                       isWeighed = false,
                  double                                     beyond = 0)
{
  std::array<double, 3> scale{};
  for (std::size_t a = 0; a < 3; ++a)
  {
    scale[a] = weights.unit * static_cast<double>(weights.weight[a]);
  }
  BoundaryGap largest{ -std::numeric_limits<double>::infinity(), {} };
  const auto  points = testing::BruteBoundaryVertices(shape);
  const auto  direction = isWeighed ? ToleranceWeights(shape, weights, points) : std::vector<double>();
  for (std::size_t at = 0; at < points.size(); ++at)
  {
    const LatticePoint & p = points[at];
    double               gap = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < radius.size(); ++i)
    {
      const double x = scale[0] * p.x - scale[0] * positions[i][0];
      const double y = scale[1] * p.y - scale[1] * positions[i][1];
      const double z = scale[2] * p.z - scale[2] * positions[i][2];
      gap = std::min(gap, std::sqrt(x * x + y * y + z * z) - radius[i]);
    }
    gap = (direction.empty() ? 1 : direction[at]) * (gap - beyond);
    if (gap > largest.largest)
    {
      largest = { gap, { p.x, p.y, p.z } };
    }
  }
  largest.largest = std::max(largest.largest, 0.0);
  return largest;
}

TEST(RefinedGapBound, IsTheHeightOrHalfADiagonalAndMoreOnlyForWhatWasPrunedOn)
{
  const std::array<double, 3> spacing{ 2, 3, 6 }; // a diagonal of 7
  EXPECT_EQ(RefinedGapBound(8, spacing).weighed, 8);
  EXPECT_EQ(RefinedGapBound(8, spacing).beyond, 0);
  EXPECT_EQ(RefinedGapBound(0, spacing).weighed, 3.5);
  const std::array<std::array<double, 3>, 2> moves{ { { 0, 0.5, 0 }, { 1, 2, 2 } } };
  EXPECT_EQ(RefinedGapBound(8, spacing, moves).weighed, 8);
  EXPECT_EQ(RefinedGapBound(8, spacing, moves).beyond, 6 + 3.5);
}

// The balls of a whole core touch every boundary vertex.
TEST(BoundaryGap, OfAWholeCoreIsNought)
{
  for (std::uint64_t seed = 50; seed < 90; ++seed)
  {
    const auto volume = testing::MakeRandomVolume(seed, 3, 10);
    SCOPED_TRACE(volume.Describe());
    const MedialComplex core = testing::CoreOf(volume.shape, volume.spacing);
    ASSERT_LT(
      LargestBoundaryGap(volume.shape, ComputeSpacingWeights(volume.spacing), core.positions, core.radius).largest,
      1e-9);
  }
}

TEST(BoundaryGap, OfNothingIsNoughtAndWithoutBallsInfinite)
{
  EXPECT_EQ(LargestBoundaryGap(VoxelShape(), SpacingWeights{}, {}, {}).largest, 0.0);
  EXPECT_EQ(LargestBoundaryGap(testing::Box({ 2, 2, 2 }), SpacingWeights{}, {}, {}).largest,
            std::numeric_limits<double>::infinity());
}

TEST(BoundaryGap, NamesThePlace)
{
  const std::vector<std::array<double, 3>> centre{ { 0.5, 0.5, 0.5 } };
  const std::vector<double>                radius{ 0.5 };
  const BoundaryGap gap = LargestBoundaryGap(testing::Box({ 1, 1, 5 }), SpacingWeights{}, centre, radius);
  EXPECT_EQ(gap.place, (std::array<std::int32_t, 3>{ 0, 0, 5 }));
  EXPECT_DOUBLE_EQ(gap.largest, std::sqrt(0.25 + 0.25 + 4.5 * 4.5) - 0.5);
}

// Looks where it begins and skips what is near, in several threads: it must still be the first of the farthest.
TEST(BoundaryGap, IsThatOfTheFirstOfTheFarthestPoints)
{
  std::vector<VoxelShape> shapes{ testing::Ellipsoid(64), testing::Box({ 40, 40, 40 }) };
  for (const auto & volume : testing::RandomVolumes(300, 30))
  {
    shapes.push_back(volume.shape);
  }
  for (const VoxelShape & shape : shapes)
  {
    const SpacingWeights weights = ComputeSpacingWeights({ 1, 1, 1 });
    const MedialComplex  rest = PruneByTolerance(testing::CoreWithTolerancesOf(shape), 1.5);
    const BoundaryGap    expected = GapByLookingAtAll(shape, weights, rest.positions, rest.radius);
    const BoundaryGap    gap = LargestBoundaryGap(shape, weights, rest.positions, rest.radius);
    EXPECT_EQ(gap.largest, expected.largest);
    EXPECT_EQ(gap.place, expected.place);
  }
}

// Balls that touch nothing, hold one another, lie at one place or are negative, in every spacing: none may be missed.
TEST(BoundaryGap, IsWhatLookingAtAllFinds)
{
  std::cout << "seeds from 400\n";
  const testing::Threads threads(3);
  for (std::uint64_t seed = 400; seed < 480; ++seed)
  {
    SCOPED_TRACE(seed);
    testing::Random      random(seed);
    const VoxelShape     shape = testing::RandomShape(random, { 70, 9, 8 }, 0.3 + 0.1 * static_cast<double>(seed % 7));
    const SpacingWeights weights = ComputeSpacingWeights(testing::TestSpacings()[seed % 6]);
    std::vector<std::array<double, 3>> positions;
    std::vector<double>                radius;
    const double                       grid = seed % 2 == 0 ? 1 : 1e-3;
    const auto                         along = [&](double side) {
      return grid * static_cast<double>(random.Between(0, static_cast<std::int64_t>(side / grid)));
    };
    for (std::int64_t i = random.Between(1, seed % 5 == 0 ? 3000 : 90); i > 0; --i)
    {
      positions.push_back({ seed % 3 == 0 ? 7 : along(70), along(9), seed % 8 == 0 ? 2 : along(8) });
      radius.push_back((random.Chance(0.1) ? 6 : 1) * random.Unit() - (random.Chance(0.1) ? 0.5 : 0));
    }
    const BoundaryGap expected = GapByLookingAtAll(shape, weights, positions, radius);
    const BoundaryGap gap = LargestBoundaryGap(shape, weights, positions, radius);
    ASSERT_EQ(gap.largest, expected.largest);
    ASSERT_EQ(gap.place, expected.place);
    // Also by direction, whose weights are found in another way than those of the makers.
    const double      beyond = seed % 2 == 0 ? 0.3 : 0;
    const BoundaryGap weighed = LargestWeighedGap(shape, weights, positions, radius, beyond);
    const double      all = GapByLookingAtAll(shape, weights, positions, radius, true, beyond).largest;
    ASSERT_NEAR(weighed.largest, all, 1e-12 * all);
    const BoundaryGaps both = LargestBoundaryGaps(shape, weights, positions, radius, beyond);
    ASSERT_EQ(both.plain.largest, gap.largest);
    ASSERT_EQ(both.weighed.largest, weighed.largest);
  }
}

// What pruning by tolerance promises, at heights on the values, where a step too many would show.
TEST(BoundaryGap, OfACorePrunedByToleranceIsAtMostTheTolerance)
{
  std::cout << "seeds from 100\n";
  for (std::uint64_t seed = 100; seed < 200; ++seed)
  {
    auto volume = testing::MakeRandomVolume(seed, 3, seed % 4 == 0 ? 20 : 10);
    if (seed % 2 == 0)
    {
      testing::Random random(seed);
      volume.density = 0.98;
      volume.shape = testing::RandomShape(random, volume.shape.Box().size, 0.98);
    }
    SCOPED_TRACE(volume.Describe());
    const SpacingWeights weights = ComputeSpacingWeights(volume.spacing);
    const MedialComplex  core = testing::CoreWithTolerancesOf(volume.shape, volume.spacing);
    std::vector<double>  heights;
    for (const double value : core.tolerances.vertices)
    {
      heights.push_back(std::isfinite(value) ? value : 1e9);
    }
    std::sort(heights.begin(), heights.end());
    heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
    for (std::size_t i = 0; i + 1 < heights.size(); i += 1 + heights.size() / 8)
    {
      const MedialComplex rest = PruneByTolerance(core, heights[i]);
      ASSERT_LE(LargestWeighedGap(volume.shape, weights, rest.positions, rest.radius).largest,
                heights[i] * (1 + 1e-12) + 1e-9);
    }
  }
}

} // namespace
} // namespace voxelcore
