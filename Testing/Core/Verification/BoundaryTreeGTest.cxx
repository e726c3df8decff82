#include "voxelcore/Verification/BoundaryTree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>
#include <set>

using namespace voxelcore;

namespace
{

std::vector<LatticePoint>
RandomPoints(std::mt19937 & generator, std::size_t count, unsigned range)
{
  std::set<LatticePoint> points;
  const auto             draw = [&] { return static_cast<std::int32_t>(generator() % range) - 5; };
  for (std::size_t i = 0; i < count; ++i)
  {
    points.insert({ draw(), draw(), draw() });
  }
  std::vector<LatticePoint> shuffled(points.begin(), points.end());
  std::shuffle(shuffled.begin(), shuffled.end(), generator);
  return shuffled;
}

} // namespace

TEST(BoundaryTree, TheCentreOfAVoxelIsAsNearToAllItsCorners)
{
  std::vector<LatticePoint> corners;
  for (std::int32_t i = 0; i < 8; ++i)
  {
    corners.push_back({ i & 1, (i >> 1) & 1, i >> 2 });
  }
  const BoundaryTree                   tree(corners, SpacingWeights{});
  std::vector<BoundaryTree::Candidate> found;
  EXPECT_DOUBLE_EQ(tree.FindNearest({ 0.5, 0.5, 0.5 }, 0, found), std::sqrt(0.75));
  EXPECT_EQ(found.size(), 8U);
}

TEST(BoundaryTree, NoPointsAreInfinitelyFar)
{
  const BoundaryTree                   tree({}, SpacingWeights{});
  std::vector<BoundaryTree::Candidate> found;
  EXPECT_TRUE(std::isinf(tree.FindNearest({ 0, 0, 0 }, 1, found)));
  EXPECT_TRUE(found.empty());
}

TEST(BoundaryTree, FindsWhatLookingAtEveryPointFinds)
{
  std::cout << "seeds 1 to 40\n";
  for (std::uint32_t seed = 1; seed <= 40; ++seed)
  {
    std::mt19937   generator(seed);
    const auto     draw = [&](unsigned below) { return static_cast<unsigned>(generator() % below); };
    SpacingWeights weights;
    weights.weight = { 1 + draw(3), 1, 1 + draw(7) };
    const BoundaryTree                   tree(RandomPoints(generator, 1 + draw(700), 2 + draw(20)), weights);
    std::vector<BoundaryTree::Candidate> found;
    for (int query = 0; query < 50; ++query)
    {
      // Half of the queries at half-integer places, where many points are equally near.
      std::array<double, 3> position{};
      for (double & coordinate : position)
      {
        coordinate = draw(60) / 2.0 - 8 + (query % 2 == 0 ? 0.0 : 1e-3 * draw(999));
      }
      const double slack = query % 3 == 0 ? 0.0 : query % 3 == 1 ? 0.5 : 2.0;
      const auto   distanceTo = [&](const LatticePoint & p) {
        return std::sqrt(std::pow(static_cast<double>(weights.weight[0]) * (position[0] - p.x), 2) +
                         std::pow(static_cast<double>(weights.weight[1]) * (position[1] - p.y), 2) +
                         std::pow(static_cast<double>(weights.weight[2]) * (position[2] - p.z), 2));
      };
      double nearest = INFINITY;
      for (const LatticePoint & p : tree.Points())
      {
        nearest = std::min(nearest, distanceTo(p));
      }
      std::vector<std::uint32_t> expected;
      for (std::uint32_t i = 0; i < tree.Points().size(); ++i)
      {
        if (distanceTo(tree.Points()[i]) <= nearest * (1 + 1e-15) + slack)
        {
          expected.push_back(i);
        }
      }
      EXPECT_NEAR(tree.FindNearest(position, slack, found), nearest, 1e-12 * nearest) << "seed " << seed;
      std::vector<std::uint32_t> places;
      for (const auto & candidate : found)
      {
        places.push_back(candidate.point);
        EXPECT_NEAR(std::sqrt(candidate.squaredDistance), distanceTo(tree.Points()[candidate.point]), 1e-12);
      }
      ASSERT_EQ(places, expected) << "seed " << seed << " query " << query;
    }
  }
}
