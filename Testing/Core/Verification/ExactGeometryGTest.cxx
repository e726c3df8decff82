#include "CellFacets.h"
#include "ExactCentre.h"
#include "NearestSets.h"
#include "SmallestBall.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <iostream>
#include <limits>
#include <random>

using namespace voxelcore;
using namespace voxelcore::verification;

namespace
{

SpacingWeights
Weights(std::int64_t x, std::int64_t y, std::int64_t z)
{
  SpacingWeights weights;
  weights.weight = { x, y, z };
  return weights;
}

std::vector<LatticePoint>
UnitCube()
{
  std::vector<LatticePoint> corners;
  for (std::int32_t i = 0; i < 8; ++i)
  {
    corners.push_back({ i & 1, (i >> 1) & 1, i >> 2 });
  }
  return corners;
}

/** All lattice points at squared distance n from the origin. */
std::vector<std::array<double, 3>>
LatticeSphere(int n)
{
  std::vector<std::array<double, 3>> points;
  for (int x = -n; x <= n; ++x)
  {
    for (int y = -n; y <= n; ++y)
    {
      for (int z = -n; z <= n; ++z)
      {
        if (x * x + y * y + z * z == n)
        {
          points.push_back({ double(x), double(y), double(z) });
        }
      }
    }
  }
  return points;
}

} // namespace

TEST(ExactCentre, TheSphereThroughACubesCornersIsCentredInIt)
{
  for (const SpacingWeights & weights : { Weights(1, 1, 1), Weights(1, 1, 2), Weights(4096, 1, 77) })
  {
    const auto cube = UnitCube();
    const auto sphere = SphereThrough({ cube[0], cube[1], cube[2], cube[4] }, weights);
    ASSERT_TRUE(sphere);
    EXPECT_EQ(Coordinates(*sphere, weights), (std::array<double, 3>{ 0.5, 0.5, 0.5 }));
    for (const LatticePoint & corner : cube)
    {
      EXPECT_EQ(PowerSign(*sphere, corner, weights), 0);
    }
    EXPECT_TRUE(PowerSign(*sphere, { 2, 0, 0 }, weights) > 0);
    // The order of the points does not matter, though it changes the sign of the determinant.
    const auto other = SphereThrough({ cube[0], cube[2], cube[1], cube[4] }, weights);
    EXPECT_EQ(CompareCentres(*sphere, *other, weights), 0);
    EXPECT_TRUE(PowerSign(*other, { 2, 0, 0 }, weights) > 0);
  }
  EXPECT_DOUBLE_EQ(
    Radius(*SphereThrough({ LatticePoint{ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } }, Weights(1, 1, 2)),
           Weights(1, 1, 2)),
    std::sqrt(6.0) / 2);
}

TEST(ExactCentre, InsideIsNegative)
{
  const SpacingWeights weights;
  const auto sphere = SphereThrough({ LatticePoint{ 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, { 0, 0, 4 } }, weights);
  EXPECT_TRUE(PowerSign(*sphere, { 1, 1, 1 }, weights) < 0);
}

TEST(ExactCentre, CoplanarPointsHaveNoSphere)
{
  EXPECT_FALSE(SphereThrough({ LatticePoint{ 0, 0, 3 }, { 1, 0, 3 }, { 0, 1, 3 }, { 1, 1, 3 } }, SpacingWeights{}));
}

TEST(ExactCentre, CentresThatDoublesConfuseAreStillOrdered)
{
  // (10^17 + 1) / 10^17 and (10^17 + 2) / (10^17 + 1) differ by 1e-34.
  const SpacingWeights weights;
  const Int128         n = 100000000000000000;
  const ExactCentre    a{ { 7, 0, 0 }, { n + 1, 0, -5 }, n };
  const ExactCentre    b{ { 7, 0, 0 }, { n + 2, 0, 0 }, n + 1 };
  ASSERT_EQ(Coordinates(a, weights)[0], Coordinates(b, weights)[0]);
  EXPECT_EQ(CompareCentres(a, b, weights), 1);
  EXPECT_EQ(CompareCentres(b, a, weights), -1);
  EXPECT_EQ(CompareCentres(a, a, weights), 0);
  // The same centre from another origin; and one that differs in z alone, below zero.
  EXPECT_EQ(CompareCentres(a, { { 6, 0, 0 }, { 3 * n + 1, 0, -5 }, n }, weights), 0);
  EXPECT_EQ(CompareCentres(a, { { 7, 0, 0 }, { n + 1, 0, -6 }, n }, weights), 1);
}

TEST(NearestSets, ANearlyNearestPointIsLeftOutExactly)
{
  // Four points at distance 20000 from the origin, a fifth 2.5e-5 further away: positions known to 5e-5 cannot tell.
  const SpacingWeights      weights;
  const std::int32_t        r = 20000;
  std::vector<LatticePoint> points{ { r, 0, 0 }, { -r, 0, 0 }, { 0, r, 0 }, { 0, 0, r } };
  points.push_back({ 12000, -16000, 1 }); // squared distance r^2 + 1
  const BoundaryTree                       tree(points, weights);
  const std::vector<std::array<double, 3>> positions{ { 1e-5, -1e-5, 1e-5 }, { 0.5, 0, 0 } };
  const NearestSets                        sets = FindNearestSets(tree, weights, positions, 5e-5);
  ASSERT_TRUE(sets.IsKnown(0));
  EXPECT_EQ(sets.Of(0).size(), 4U);
  for (const std::uint32_t place : sets.Of(0))
  {
    EXPECT_NE(tree.Points()[place].x, 12000);
  }
  EXPECT_FALSE(sets.IsKnown(1));
}

TEST(NearestSets, ASphereWithAPointInsideIsNoneEvenWhereItsCentreIsNearer)
{
  // As before; the position is the centre (t, t, t), t = -1/47998, of the sphere through the fifth point instead of
  // (-r, 0, 0), which lies inside that sphere.
  const std::int32_t        r = 20000;
  std::vector<LatticePoint> points{ { r, 0, 0 }, { -r, 0, 0 }, { 0, r, 0 }, { 0, 0, r }, { 12000, -16000, 1 } };
  const BoundaryTree        tree(points, SpacingWeights{});
  const double              t = -1.0 / 47998;
  const NearestSets         sets =
    FindNearestSets(tree, SpacingWeights{}, std::vector<std::array<double, 3>>{ { t, t, t } }, 5e-5);
  ASSERT_EQ(sets.Of(0).size(), 4U);
  for (const std::uint32_t place : sets.Of(0))
  {
    EXPECT_NE(tree.Points()[place].x, 12000);
  }
}

TEST(NearestSets, APositionBesideTheCentreIsNone)
{
  const BoundaryTree                       tree(UnitCube(), SpacingWeights{});
  const std::vector<std::array<double, 3>> positions{ { 0.5009, 0.5, 0.5 }, { 0.5015, 0.5, 0.5 } };
  const NearestSets                        sets = FindNearestSets(tree, SpacingWeights{}, positions, 1e-3);
  EXPECT_EQ(sets.Of(0).size(), 8U);
  EXPECT_FALSE(sets.IsKnown(1));
}

TEST(SmallestBall, KnownBalls)
{
  using Points = std::vector<std::array<double, 3>>;
  EXPECT_DOUBLE_EQ(SmallestBallSquaredRadius(Points{ { 3, 4, 5 } }), 0);
  EXPECT_DOUBLE_EQ(SmallestBallSquaredRadius(Points{ { 0, 0, 0 }, { 0, 0, 3 } }), 2.25);
  // A right triangle: its hypotenuse; an obtuse one: its longest side; an equilateral one: its circumcircle.
  EXPECT_DOUBLE_EQ(SmallestBallSquaredRadius(Points{ { 0, 0, 0 }, { 4, 0, 0 }, { 0, 2, 0 } }), 5);
  EXPECT_DOUBLE_EQ(SmallestBallSquaredRadius(Points{ { 0, 0, 0 }, { 10, 0, 0 }, { 5, 1, 0 } }), 25);
  EXPECT_DOUBLE_EQ(SmallestBallSquaredRadius(Points{ { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } }), 2.0 / 3);
  // A regular tetrahedron, and the cube around it.
  EXPECT_DOUBLE_EQ(SmallestBallSquaredRadius(Points{ { 0, 0, 0 }, { 1, 1, 0 }, { 1, 0, 1 }, { 0, 1, 1 } }), 0.75);
}

TEST(SmallestBall, SubsetsOfALatticeSphereAgreeWithAnIterationThatConverges)
{
  std::cout << "seeds 1 to 300\n";
  for (std::uint32_t seed = 1; seed <= 300; ++seed)
  {
    std::mt19937 generator(seed);
    auto         points = LatticeSphere(std::array{ 9, 26, 29, 41, 54 }[seed % 5]);
    std::shuffle(points.begin(), points.end(), generator);
    points.resize(2 + generator() % 9);
    double best = std::numeric_limits<double>::infinity();
    // Badoiu and Clarkson: step towards the farthest point; converges slowly but surely from any start.
    std::array<double, 3> centre = points[0];
    for (int step = 1; step <= 20000; ++step)
    {
      std::size_t farthest = 0;
      double      largest = -1;
      for (std::size_t i = 0; i < points.size(); ++i)
      {
        double squared = 0;
        for (std::size_t a = 0; a < 3; ++a)
        {
          squared += std::pow(points[i][a] - centre[a], 2);
        }
        if (squared > largest)
        {
          largest = squared;
          farthest = i;
        }
      }
      best = std::min(best, largest);
      for (std::size_t a = 0; a < 3; ++a)
      {
        centre[a] += (points[farthest][a] - centre[a]) / (step + 1);
      }
    }
    const double radius = std::sqrt(SmallestBallSquaredRadius(points));
    EXPECT_LE(radius, std::sqrt(best) * (1 + 1e-9)) << "seed " << seed;
    EXPECT_GE(radius, std::sqrt(best) * (1 - 1e-3)) << "seed " << seed;
  }
}

TEST(CellFacets, ACubeHasSixAndATetrahedronFour)
{
  CellFacets facets;
  FindFacets(UnitCube(), facets);
  ASSERT_EQ(facets.Count(), 6U);
  for (std::size_t f = 0; f < 6; ++f)
  {
    EXPECT_EQ(std::popcount(facets.Mask(f)[0]), 4);
  }
  FindFacets(std::vector<LatticePoint>{ { 0, 0, 0 }, { 3, 0, 0 }, { 0, 2, 0 }, { 0, 0, 5 } }, facets);
  EXPECT_EQ(facets.Count(), 4U);
}

TEST(CellFacets, LargeCellsKeepEulersFormula)
{
  // Squared radius 54: 96 points, more than a word holds. Every two facets that share two points share an edge.
  std::vector<LatticePoint> points;
  for (const auto & p : LatticeSphere(54))
  {
    points.push_back(
      { static_cast<std::int32_t>(p[0]), static_cast<std::int32_t>(p[1]), static_cast<std::int32_t>(p[2]) });
  }
  ASSERT_GT(points.size(), 64U);
  CellFacets facets;
  FindFacets(points, facets);
  std::size_t edges = 0;
  for (std::size_t f = 0; f < facets.Count(); ++f)
  {
    for (std::size_t g = f + 1; g < facets.Count(); ++g)
    {
      int shared = 0;
      for (std::size_t word = 0; word < facets.stride; ++word)
      {
        shared += std::popcount(facets.Mask(f)[word] & facets.Mask(g)[word]);
      }
      edges += shared == 2 ? 1 : 0;
    }
  }
  EXPECT_EQ(points.size() + facets.Count(), edges + 2);
}
