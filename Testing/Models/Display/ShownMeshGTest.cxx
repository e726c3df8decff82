// Meshes with fewer triangles for showing keep their form: closed surfaces stay closed, and nothing of a core vanishes.

#include "ShownMesh.h"

#include "VoxelCoreTesting/Shapes.h"
#include "voxelcore/Base/UnionFind.h"
#include "voxelcore/Display/LabelSurface.h"
#include "voxelcore/VoxelCore/LambdaPruning.h"
#include "voxelcore/VoxelCore/VoxelCore.h"

#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <set>

namespace voxelcore::testing
{
namespace
{

MedialComplex
Core(const VoxelShape & shape, double lambda)
{
  const auto weights = ComputeSpacingWeights({ 1, 1, 1 });
  const auto pruned = PruneByLambda(ComputeVoxelCore(shape, weights), { lambda });
  return ToPhysical(pruned.front(), ImageGeometry{ { 64, 64, 64 } }, 1).core;
}

double
DistanceToNearest(const std::array<float, 3> & point, const std::vector<std::array<double, 3>> & others)
{
  double least = 1e30;
  for (const auto & other : others)
  {
    least = std::min(least, std::hypot(point[0] - other[0], point[1] - other[1], point[2] - other[2]));
  }
  return least;
}

std::size_t
Pieces(const ShownMesh & mesh)
{
  UnionFind sets(mesh.points.size());
  for (const auto & t : mesh.triangles)
  {
    sets.Unite(t[0], t[1]);
    sets.Unite(t[0], t[2]);
  }
  for (const auto & s : mesh.segments)
  {
    sets.Unite(s[0], s[1]);
  }
  std::set<std::size_t> roots;
  for (std::uint32_t point = 0; point < mesh.points.size(); ++point)
  {
    roots.insert(sets.Find(point));
  }
  return roots.size();
}

TEST(SimplifiedSurface, StaysClosedAndWhereItWas)
{
  ImageGeometry geometry;
  geometry.size = { 64, 64, 64 };
  const LabelSurfaceMesh full = LabelSurface(Ellipsoid(48), geometry);
  const ShownMesh        few = SimplifiedSurface(full, 800);
  EXPECT_GT(full.triangles.size(), 8000U);
  EXPECT_LE(few.triangles.size(), 820U);
  EXPECT_GT(few.triangles.size(), 700U);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  double                                                 volume = 0;
  for (const auto & t : few.triangles)
  {
    const auto & a = few.points[t[0]];
    const auto & b = few.points[t[1]];
    const auto & c = few.points[t[2]];
    volume +=
      (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])) /
      6.0;
    for (std::size_t k = 0; k < 3; ++k)
    {
      ++edges[{ t[k], t[(k + 1) % 3] }];
    }
  }
  for (const auto & [edge, count] : edges)
  {
    ASSERT_EQ(count, 1);
    ASSERT_EQ(edges.count({ edge.second, edge.first }), 1U) << "a hole";
  }
  EXPECT_NEAR(volume / static_cast<double>(Ellipsoid(48).CountVoxels()), 1, 0.03);
}

TEST(SimplifiedComplex, KeepsItsPiecesItsReachAndTheValuesOfItsPoints)
{
  const MedialComplex core = Core(Ellipsoid(48), 1.5);
  const ComplexSize   size = SizeOf(core.cells);
  const ShownMesh     full = SimplifiedComplex(core, size.triangles + size.edges);
  EXPECT_EQ(full.triangles.size(), size.triangles);
  for (const std::size_t most : { 400U, 60U, 4U })
  {
    const ShownMesh few = SimplifiedComplex(core, most);
    EXPECT_LE(few.triangles.size() + few.segments.size(), most + most / 20 + 1);
    EXPECT_GT(few.triangles.size() + few.segments.size(), 0U);
    EXPECT_EQ(Pieces(few), Pieces(full)) << most;
    ASSERT_EQ(few.origin.size(), few.points.size());
    for (std::size_t i = 0; i < few.points.size(); ++i)
    {
      const auto & at = core.positions[few.origin[i]];
      for (std::size_t k = 0; k < 3; ++k)
      {
        ASSERT_FLOAT_EQ(few.points[i][k], static_cast<float>(at[k]));
      }
    }
  }
  // Rims stay: the farthest points of the sheet are not drawn back by more than a cell's side.
  const ShownMesh few = SimplifiedComplex(core, 400);
  double          reach[2] = { 1e30, -1e30 };
  double          before[2] = { 1e30, -1e30 };
  for (const auto & point : few.points)
  {
    EXPECT_LT(DistanceToNearest(point, core.positions), 1e-5);
    reach[0] = std::min<double>(reach[0], point[0]);
    reach[1] = std::max<double>(reach[1], point[0]);
  }
  for (const auto & point : core.positions)
  {
    before[0] = std::min(before[0], point[0]);
    before[1] = std::max(before[1], point[0]);
  }
  EXPECT_NEAR(reach[0], before[0], 1.5);
  EXPECT_NEAR(reach[1], before[1], 1.5);
}

TEST(SimplifiedComplex, NothingVanishes)
{
  // Two plates of very different size: the small one is less than a cell of the budget.
  VoxelShape shape(VoxelBox{ { 0, 0, 0 }, { 60, 60, 20 } });
  for (std::int32_t y = 0; y < 60; ++y)
  {
    for (std::int32_t x = 0; x < 60; ++x)
    {
      shape.Insert(x, y, 0);
      shape.Insert(x, y, 1);
    }
  }
  for (std::int32_t k = 0; k < 3; ++k)
  {
    shape.Insert(30 + k, 30, 15);
    shape.Insert(30 + k, 31, 15);
  }
  const MedialComplex core = Core(shape, 0);
  for (const std::size_t most : { 200U, 50U })
  {
    const ShownMesh few = SimplifiedComplex(core, most);
    EXPECT_EQ(Pieces(few), 2U) << most;
  }
}

TEST(SimplifiedComplex, OfNothingIsNothing)
{
  EXPECT_TRUE(SimplifiedComplex(MedialComplex(), 10).points.empty());
  EXPECT_TRUE(SimplifiedSurface(LabelSurfaceMesh(), 10).points.empty());
  EXPECT_TRUE(ShownCurves(SkeletonGraph()).points.empty());
}

} // namespace
} // namespace voxelcore::testing
