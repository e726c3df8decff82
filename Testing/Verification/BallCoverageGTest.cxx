#include "voxelcore/BallCoverage.h"

#include "VoxelCoreTesting/Cores.h"

#include "voxelcore/BoundaryVertices.h"
#include "voxelcore/TolerancePruning.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <limits>

namespace voxelcore
{
namespace
{

double
GapByLookingAtAll(const std::array<double, 3> &              place,
                  const std::vector<std::array<double, 3>> & positions,
                  const std::vector<double> &                radius,
                  const SpacingWeights &                     weights)
{
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    double squared = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double d = weights.unit * static_cast<double>(weights.weight[axis]) * (place[axis] - positions[i][axis]);
      squared += d * d;
    }
    best = std::min(best, std::sqrt(squared) - radius[i]);
  }
  return best;
}

TEST(BallTree, FindsTheBallThatLookingAtAllFinds)
{
  for (std::uint64_t seed = 1; seed <= 40; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    testing::Random      random(seed);
    const SpacingWeights weights = ComputeSpacingWeights(testing::TestSpacings()[seed % 6]);
    const auto           place = [&] {
      // On a coarse grid half of the time, so that equal distances and splits occur.
      const double grid = seed % 2 == 0 ? 1.0 : 1e-3;
      return std::array<double, 3>{ grid * static_cast<double>(random.Between(0, static_cast<std::int64_t>(20 / grid))),
                                    grid * static_cast<double>(random.Between(0, static_cast<std::int64_t>(20 / grid))),
                                    grid *
                                      static_cast<double>(random.Between(0, static_cast<std::int64_t>(20 / grid))) };
    };
    std::vector<std::array<double, 3>> positions;
    std::vector<double>                radius;
    for (std::int64_t i = random.Between(1, 200); i > 0; --i)
    {
      positions.push_back(place());
      radius.push_back(random.Unit() * (random.Chance(0.1) ? 10 : 1));
    }
    const BallTree tree(positions, radius, weights);
    for (int i = 0; i < 100; ++i)
    {
      const auto at = place();
      ASSERT_NEAR(tree.Gap(at), GapByLookingAtAll(at, positions, radius, weights), 1e-11);
    }
  }
}

TEST(BallTree, WithoutBallsIsInfinitelyFar)
{
  EXPECT_EQ(BallTree({}, {}, SpacingWeights{}).Gap({ 0, 0, 0 }), std::numeric_limits<double>::infinity());
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
    const BallTree       tree(rest.positions, rest.radius, weights);
    BoundaryGap          expected;
    bool                 isFirst = true;
    for (const LatticePoint & p : BoundaryVertices(shape))
    {
      const double gap = tree.Gap({ static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z) });
      if (isFirst || gap > expected.largest)
      {
        expected = { gap, { p.x, p.y, p.z } };
      }
      isFirst = false;
    }
    const BoundaryGap gap = LargestBoundaryGap(shape, weights, rest.positions, rest.radius);
    EXPECT_EQ(gap.largest, std::max(0.0, expected.largest));
    EXPECT_EQ(gap.place, expected.place);
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
      ASSERT_LE(LargestBoundaryGap(volume.shape, weights, rest.positions, rest.radius).largest,
                heights[i] * (1 + 1e-12) + 1e-9);
    }
  }
}

} // namespace
} // namespace voxelcore
