#include "voxelcore/Lattice/ConvexHull.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace voxelcore::testing
{
namespace
{

using Point = std::array<std::int64_t, 3>;

Point
Minus(const Point & a, const Point & b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

Point
Cross(const Point & a, const Point & b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

std::int64_t
Dot(const Point & a, const Point & b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/** Whether the point is on the right side of every plane that has three of the points on it and none beyond. */
bool
IsInHullByBruteForce(const std::vector<Point> & points, const Point & at)
{
  for (const Point & a : points)
  {
    for (const Point & b : points)
    {
      for (const Point & c : points)
      {
        const Point normal = Cross(Minus(b, a), Minus(c, a));
        bool        bounds = normal != Point{ 0, 0, 0 };
        for (const Point & other : points)
        {
          bounds = bounds && Dot(normal, Minus(other, a)) <= 0;
        }
        if (bounds && Dot(normal, Minus(at, a)) > 0)
        {
          return false;
        }
      }
    }
  }
  return true;
}

bool
IsInHull(const std::vector<Point> & points, const std::vector<HullFacet> & facets, const Point & at)
{
  for (const HullFacet & facet : facets)
  {
    if (Dot(facet.normal, Minus(at, points[facet.corners[0]])) > 0)
    {
      return false;
    }
  }
  return true;
}

TEST(ConvexHull, HasTheLatticePointsThatBruteForceFinds)
{
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  for (int run = 0; run < 150; ++run)
  {
    // Few coordinates, so that many points lie in one plane, on one line, or in one place.
    const std::int64_t              side = 2 + run % 3;
    std::uniform_int_distribution<> place(0, static_cast<int>(side));
    std::vector<Point>              points(4 + static_cast<std::size_t>(run % 9));
    for (Point & point : points)
    {
      point = { place(random), place(random), place(random) };
    }
    const std::vector<HullFacet> facets = ConvexHull(points);
    if (facets.empty())
    {
      for (const Point & a : points)
      {
        for (const Point & b : points)
        {
          for (const Point & c : points)
          {
            ASSERT_EQ(Dot(Cross(Minus(a, points[0]), Minus(b, points[0])), Minus(c, points[0])), 0);
          }
        }
      }
      continue;
    }
    for (std::int64_t z = -1; z <= side + 1; ++z)
    {
      for (std::int64_t y = -1; y <= side + 1; ++y)
      {
        for (std::int64_t x = -1; x <= side + 1; ++x)
        {
          ASSERT_EQ(IsInHull(points, facets, { x, y, z }), IsInHullByBruteForce(points, { x, y, z }))
            << "run " << run << " at " << x << " " << y << " " << z;
        }
      }
    }
  }
}

TEST(ConvexHull, IsAClosedSurfaceOfTrianglesThatAreNotFlat)
{
  std::vector<Point> points;
  for (std::int64_t i = 0; i < 27; ++i)
  {
    points.push_back({ i % 3, i / 3 % 3, i / 9 });
  }
  const std::vector<HullFacet>                       facets = ConvexHull(points);
  std::map<std::pair<std::size_t, std::size_t>, int> edges;
  for (const HullFacet & facet : facets)
  {
    EXPECT_NE(facet.normal, (Point{ 0, 0, 0 }));
    for (std::size_t k = 0; k < 3; ++k)
    {
      ++edges[{ facet.corners[k], facet.corners[(k + 1) % 3] }];
    }
  }
  ASSERT_FALSE(facets.empty());
  for (const auto & [edge, count] : edges)
  {
    EXPECT_EQ(count, 1);
    EXPECT_TRUE(edges.contains({ edge.second, edge.first }));
  }
}

TEST(ConvexHull, OfFarPointsIsExact)
{
  constexpr std::int64_t   far = std::int64_t{ 1 } << 29;
  const std::vector<Point> points{ { -far, -far, -far },
                                   { far, -far, -far },
                                   { -far, far, -far },
                                   { -far, -far, far },
                                   { 1 - far, 1 - far, -far } };
  EXPECT_EQ(ConvexHull(points).size(), 4U) << "the last lies in a face";
}

TEST(ConvexHull, OfPointsInAPlaneHasNoFacets)
{
  EXPECT_TRUE(ConvexHull({}).empty());
  EXPECT_TRUE(ConvexHull({ { 1, 2, 3 } }).empty());
  EXPECT_TRUE(ConvexHull({ { 0, 0, 0 }, { 1, 1, 1 }, { 2, 2, 2 }, { 0, 0, 0 } }).empty());
  EXPECT_TRUE(ConvexHull({ { 0, 0, 1 }, { 1, 0, 1 }, { 0, 1, 1 }, { 5, 7, 1 } }).empty());
}

} // namespace
} // namespace voxelcore::testing
