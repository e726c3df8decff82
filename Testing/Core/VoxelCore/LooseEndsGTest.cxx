// Loose ends that pruning by tolerance leaves.

#include "VoxelCoreTesting/Cores.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <vector>

namespace voxelcore
{
namespace
{

// Whether a boundary vertex lies within the height of this ball only.
bool
IsNeeded(const MedialComplex & core, std::size_t end, const std::vector<LatticePoint> & points, double height)
{
  const auto isNear = [&](const LatticePoint & p, std::size_t vertex) {
    const auto & c = core.positions[vertex];
    return std::hypot(p.x - c[0], p.y - c[1], p.z - c[2]) - core.radius[vertex] < height;
  };
  return std::any_of(points.begin(), points.end(), [&](const LatticePoint & p) {
    if (!isNear(p, end))
    {
      return false;
    }
    for (std::size_t vertex = 0; vertex < core.positions.size(); ++vertex)
    {
      if (vertex != end && isNear(p, vertex))
      {
        return false;
      }
    }
    return true;
  });
}

TEST(LooseEnds, MostlyKeepWhatNoOtherBallDoes)
{
  constexpr std::uint64_t seed = 20261;
  std::cout << "seed " << seed << '\n';
  testing::Random random(seed);
  const double    height = 1.2 * std::sqrt(3.0);
  int             ends = 0;
  int             needed = 0;
  for (int i = 0; i < 6; ++i)
  {
    // A thick slab with a rough wall.
    const VoxelShape    shape = testing::ShapeWhere({ 44, 44, 26 }, [&](int x, int y, int z) {
      const double du = std::max(0.0, std::abs(x - 21.5) - 8);
      const double dv = std::max(0.0, std::abs(y - 21.5) - 8);
      return std::hypot(du, dv, z - 12.5) <= 9 + 1.6 * random.Unit();
    });
    const MedialComplex left = PruneByTolerance(testing::CoreWithTolerancesOf(shape), height);
    const auto          points = BoundaryVertices(shape);
    std::vector<int>    edgesAt(left.cells.vertexCount, 0);
    for (const auto & edge : left.cells.edges)
    {
      ++edgesAt[edge[0]];
      ++edgesAt[edge[1]];
    }
    for (std::size_t vertex = 0; vertex < edgesAt.size(); ++vertex)
    {
      if (edgesAt[vertex] == 1)
      {
        ++ends;
        needed += IsNeeded(left, vertex, points, height) ? 1 : 0;
      }
    }
  }
  std::cout << needed << " of " << ends << " loose ends are needed\n";
  EXPECT_GE(needed, 0.66 * ends); // 0.62 before what is farthest was searched for
}

} // namespace
} // namespace voxelcore
