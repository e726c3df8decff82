// Sheets that stay keep their rims (WholeSheets.h).

#include "VoxelCoreTesting/Cores.h"

#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/VoxelCore/PolygonArea.h"
#include "voxelcore/VoxelCore/TolerancePruning.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>

namespace voxelcore
{
namespace
{

/** What `contains` of a body's axes, turned, in the middle of 48 voxels. */
MedialComplex
TurnedCore(int turn, const std::function<bool(double u, double v, double w)> & contains)
{
  const double a = 0.37 * turn;
  const double b = 0.61 * turn;
  return testing::CoreWithTolerancesOf(testing::ShapeWhere({ 48, 48, 48 }, [&](int i, int j, int k) {
    const double x = i + 0.5 - 24.2;
    const double y = j + 0.5 - 23.9;
    const double z = k + 0.5 - 24.1;
    const double u = std::cos(a) * x + std::sin(a) * y;
    const double v = std::cos(b) * (std::cos(a) * y - std::sin(a) * x) + std::sin(b) * z;
    const double w = std::cos(b) * z - std::sin(b) * (std::cos(a) * y - std::sin(a) * x);
    return contains(u, v, w);
  }));
}

/** A slab of radius 5 around a rectangle of 26 by 18. */
MedialComplex
TurnedSlab(int turn)
{
  return TurnedCore(turn, [](double u, double v, double w) {
    const double du = std::max(0.0, std::abs(u) - 13);
    const double dv = std::max(0.0, std::abs(v) - 9);
    return du * du + dv * dv + w * w <= 5 * 5;
  });
}

double
AreaOf(const MedialComplex & core)
{
  double area = 0;
  for (std::size_t face = 0; face < core.cells.FaceCount(); ++face)
  {
    area += PolygonArea(core.positions, core.cells.FaceVertices(face));
  }
  return area;
}

// Loose ends along the rim of a slab: a ball beside them often keeps what theirs kept.
TEST(WholeSheets, LeavesFewLooseEndsAlongARim)
{
  std::size_t all = 0;
  for (int turn = 1; turn <= 4; ++turn)
  {
    const MedialComplex rest = PruneByTolerance(TurnedSlab(turn), 1.2 * std::sqrt(3.0));
    std::vector<int>    edgesAt(rest.cells.vertexCount, 0);
    for (const auto & edge : rest.cells.edges)
    {
      ++edgesAt[edge[0]];
      ++edgesAt[edge[1]];
    }
    all += static_cast<std::size_t>(std::count(edgesAt.begin(), edgesAt.end(), 1));
    EXPECT_GT(rest.cells.FaceCount(), 50U) << "the sheet is gone";
  }
  std::cout << all << " loose ends on four slabs\n";
  EXPECT_LE(all, 4U);
}

// Fire from its rims would take a fifth of it at the first height, and half at the last.
TEST(WholeSheets, KeepsASheetToItsRimsUpToFourDiagonals)
{
  for (int turn = 1; turn <= 4; ++turn)
  {
    const MedialComplex core = TurnedSlab(turn);
    for (const double diagonals : { 1.0, 1.2, 2.0, 3.9 })
    {
      const double area = AreaOf(PruneByTolerance(core, diagonals * std::sqrt(3.0)));
      std::cout << "turn " << turn << ", " << diagonals << " diagonals: " << area / (26 * 18) << '\n';
      EXPECT_GT(area, 0.93 * 26 * 18);
      EXPECT_LT(area, 1.12 * 26 * 18);
    }
  }
}

// Teeth make it longer.
TEST(WholeSheets, RimsAreHardlyLongerThanTheyMustBe)
{
  for (int turn = 1; turn <= 4; ++turn)
  {
    const MedialComplex rest = PruneByTolerance(TurnedSlab(turn), 1.2 * std::sqrt(3.0));
    const auto          faces = CountEdgeCofaces(rest.cells);
    double              length = 0;
    for (std::size_t edge = 0; edge < faces.size(); ++edge)
    {
      const auto & [p, q] = rest.cells.edges[edge];
      length += faces[edge].count == 1 ? Distance(rest.positions[p], rest.positions[q]) : 0;
    }
    std::cout << "turn " << turn << ": " << length / (2 * (26 + 18)) << '\n';
    EXPECT_LT(length, 1.35 * 2 * (26 + 18));
  }
}

// Near the sides of a plate its sheet splits in two, which go to the edges at 45 degrees, where balls vanish.
TEST(WholeSheets, KeepsNoSheetInTheCornersOfAPlate)
{
  for (int turn = 1; turn <= 4; ++turn)
  {
    const MedialComplex core = TurnedCore(turn, [](double u, double v, double w) {
      return std::abs(u) < 16 && std::abs(v) < 12 && std::abs(w) < 3;
    });
    const MedialComplex rest = PruneByTolerance(core, 1.2 * std::sqrt(3.0));
    double              corners = 0;
    for (std::size_t face = 0; face < rest.cells.FaceCount(); ++face)
    {
      const auto vertices = rest.cells.FaceVertices(face);
      const bool isSmall = std::all_of(vertices.begin(), vertices.end(), [&](auto v) { return rest.radius[v] < 2; });
      corners += isSmall ? PolygonArea(rest.positions, vertices) : 0;
    }
    std::cout << "turn " << turn << ": " << AreaOf(rest) / (26 * 18) << ", of that in corners " << corners << '\n';
    EXPECT_GT(AreaOf(rest), 0.93 * 26 * 18);
    EXPECT_LT(corners, 0.02 * 26 * 18);
  }
}

} // namespace
} // namespace voxelcore
