#include "voxelcore/VoxelCore/BallTree.h"

#include "VoxelCoreTesting/Random.h"
#include "VoxelCoreTesting/Shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
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

TEST(BallTree, FindsTheBallsThatLookingAtAllFinds)
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
      std::vector<std::uint32_t> within;
      for (std::uint32_t ball = 0; ball < radius.size(); ++ball)
      {
        if (BallTree({ &positions[ball], 1 }, { &radius[ball], 1 }, weights).Gap(at) <= 2)
        {
          within.push_back(ball);
        }
      }
      std::vector<std::uint32_t> found;
      tree.FindWithin(at, 2, found);
      ASSERT_EQ(found, within);
      for (std::size_t number = 0; number < radius.size(); ++number)
      {
        const std::uint32_t ball = tree.BallOf(number);
        ASSERT_EQ(tree.IsWithin(at, 2, number),
                  BallTree({ &positions[ball], 1 }, { &radius[ball], 1 }, weights).Gap(at) < 2);
      }
      ASSERT_FALSE(tree.IsWithin(at, 2, radius.size()));
    }
  }
}

TEST(BallTree, WithoutBallsIsInfinitelyFar)
{
  EXPECT_EQ(BallTree({}, {}, SpacingWeights{}).Gap({ 0, 0, 0 }), std::numeric_limits<double>::infinity());
}

} // namespace
} // namespace voxelcore
