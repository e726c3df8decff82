#include "voxelcore/VoxelCore/PolygonArea.h"

#include "VoxelCoreTesting/Random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace voxelcore
{
namespace
{

using Points = std::vector<std::array<double, 3>>;

TEST(PolygonArea, OfSquaresTrianglesAndAnLIsKnown)
{
  const Points points{ { 0, 0, 5 }, { 2, 0, 5 }, { 2, 2, 5 }, { 0, 2, 5 }, { 1, 2, 5 }, { 1, 1, 5 }, { 2, 1, 5 } };
  const ElementIndex square[] = { 0, 1, 2, 3 };
  const ElementIndex triangle[] = { 1, 2, 3 };
  const ElementIndex corner[] = { 0, 1, 6, 5, 4, 3 }; // bent inwards
  EXPECT_EQ(PolygonArea(points, square), 4);
  EXPECT_EQ(PolygonArea(points, triangle), 2);
  EXPECT_EQ(PolygonArea(points, corner), 3);
}

TEST(PolygonArea, DoesNotDependOnWhereAPolygonBeginsHowItTurnsNorWhereItLies)
{
  constexpr std::uint64_t seed = 8;
  testing::Random         random(seed);
  for (int round = 0; round < 50; ++round)
  {
    // A star around its middle, by the shoelace formula, then put into space.
    const auto                corners = static_cast<std::size_t>(random.Between(3, 9));
    Points                    points;
    std::vector<double>       u;
    std::vector<double>       v;
    const double              tilt = random.Unit();
    std::vector<ElementIndex> order(corners);
    std::iota(order.begin(), order.end(), 0U);
    for (std::size_t i = 0; i < corners; ++i)
    {
      const double angle = 2 * 3.14159265358979 * static_cast<double>(i) / static_cast<double>(corners);
      const double radius = 1 + random.Unit();
      u.push_back(radius * std::cos(angle));
      v.push_back(radius * std::sin(angle));
      points.push_back({ u[i] + 100, v[i] * std::cos(tilt) - 50, v[i] * std::sin(tilt) });
    }
    double expected = 0;
    for (std::size_t i = 0; i < corners; ++i)
    {
      const std::size_t next = (i + 1) % corners;
      expected += (u[i] * v[next] - u[next] * v[i]) / 2;
    }
    for (std::size_t turn = 0; turn < corners; ++turn)
    {
      std::rotate(order.begin(), order.begin() + 1, order.end());
      EXPECT_NEAR(PolygonArea(points, order), expected, 1e-10) << "seed " << seed;
    }
    std::reverse(order.begin(), order.end());
    EXPECT_NEAR(PolygonArea(points, order), expected, 1e-10) << "seed " << seed;
  }
}

} // namespace
} // namespace voxelcore
