#include "CellHull.h"

#include <cmath>
#include <gtest/gtest.h>

namespace voxelcore
{
namespace
{

// By Euler's formula. Its polygons have 69,000 corners in all, more than 16 bits count.
TEST(CellHull, OfManyThousandCosphericalPointsCloses)
{
  constexpr std::int32_t    square = 420089;
  std::vector<LatticePoint> points;
  for (std::int32_t z = -649; z <= 649; ++z)
  {
    for (std::int32_t y = -649; y <= 649; ++y)
    {
      const std::int32_t rest = square - z * z - y * y;
      const auto         x = static_cast<std::int32_t>(std::lround(std::sqrt(std::max(0, rest))));
      if (rest >= 0 && x * x == rest)
      {
        points.push_back({ -x, y, z });
        if (x > 0)
        {
          points.push_back({ x, y, z });
        }
      }
    }
  }
  ASSERT_EQ(points.size(), 12864U);
  const HullFacets hull = ComputeHull(points);
  ASSERT_EQ(hull.corners.size() % 2, 0U);
  EXPECT_GT(hull.corners.size(), 65536U);
  EXPECT_EQ(points.size() - hull.corners.size() / 2 + hull.Count(), 2U);
}

} // namespace
} // namespace voxelcore
