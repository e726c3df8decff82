// What a refined core promises.

#include "RefinedCores.h"

#include "voxelcore/Complex/ComplexTopology.h"
#include "voxelcore/Shape/ShapeTopology.h"

#include <omp.h>

#include <algorithm>
#include <cmath>

namespace voxelcore::testing
{
namespace
{

// Everything the header promises of any refined core.
void
ExpectGuarded(const RefinedCore & refined, const VoxelShape & shape, const Spacing3 & spacing)
{
  const MedialComplex & core = refined.core;
  ASSERT_EQ(ComputeComplexTopology(core.cells), ComputeShapeTopology(shape));
  ASSERT_EQ(core.positions.size(), core.cells.vertexCount);
  ASSERT_EQ(refined.displacement.size(), core.cells.vertexCount);
  std::vector<Vector3> before;
  const auto           points = BoundaryVertices(shape);
  const double         half = 0.5 * std::hypot(spacing[0], spacing[1], spacing[2]) * (1 + 1e-9);
  for (std::size_t vertex = 0; vertex < core.positions.size(); ++vertex)
  {
    const Vector3 & p = core.positions[vertex];
    double          nearest = 1e9;
    for (const LatticePoint & q : points)
    {
      nearest =
        std::min(nearest, std::hypot(spacing[0] * (p[0] - q.x), spacing[1] * (p[1] - q.y), spacing[2] * (p[2] - q.z)));
    }
    ASSERT_NEAR(core.radius[vertex], nearest, half) << "vertex " << vertex;
    const Vector3 & d = refined.displacement[vertex];
    ASSERT_TRUE(LiesInOpenShape(shape, core.positions[vertex])) << "vertex " << vertex;
    ASSERT_LE(std::hypot(d[0], d[1], d[2]), 1.0) << "vertex " << vertex;
    ASSERT_GT(core.radius[vertex], 0) << "vertex " << vertex;
    before.push_back(Minus(core.positions[vertex], d));
  }
  for (std::size_t face = 0; face < core.cells.FaceCount(); ++face)
  {
    const auto corners = core.cells.FaceVertices(face);
    ASSERT_EQ(corners.size(), 3U);
    const auto & p = core.positions;
    bool         moved = false;
    for (const ElementIndex corner : corners)
    {
      moved = moved || refined.displacement[corner] != Vector3{ 0, 0, 0 };
    }
    const Vector3 n0 = Normal(before[corners[0]], before[corners[1]], before[corners[2]], spacing);
    const Vector3 n1 = Normal(p[corners[0]], p[corners[1]], p[corners[2]], spacing);
    if (moved)
    {
      ASSERT_GE(n0[0] * n1[0] + n0[1] * n1[1] + n0[2] * n1[2], -1e-12) << "face " << face;
    }
    for (std::size_t i = 0; i < 3; ++i)
    {
      const auto & edge = core.cells.edges[core.cells.FaceEdges(face)[i]];
      ASSERT_EQ(edge[0], std::min(corners[i], corners[(i + 1) % 3]));
      ASSERT_EQ(edge[1], std::max(corners[i], corners[(i + 1) % 3]));
      ASSERT_LE(core.faceLambda[face], core.edgeLambda[core.cells.FaceEdges(face)[i]]);
    }
  }
  for (std::size_t edge = 0; edge < core.cells.edges.size(); ++edge)
  {
    for (const ElementIndex end : core.cells.edges[edge])
    {
      ASSERT_LE(core.edgeLambda[edge], core.vertexLambda[end]);
    }
  }
}

TEST(RefineCore, HoldsItsPromisesOnRandomAndPorousVolumes)
{
  for (const RandomVolume & volume : RandomVolumes(4100, 40))
  {
    SCOPED_TRACE(volume.Describe());
    const double least = *std::min_element(volume.spacing.begin(), volume.spacing.end());
    for (const double threshold : { 0.0, 1.5 * least })
    {
      ExpectGuarded(Refine(volume.shape, volume.spacing, threshold), volume.shape, volume.spacing);
    }
  }
}

TEST(RefineCore, HoldsItsPromisesOnDegenerateShapes)
{
  VoxelShape touching(VoxelBox{ { 0, 0, 0 }, { 2, 2, 2 } });
  touching.Insert(0, 0, 0);
  touching.Insert(1, 1, 1);
  VoxelShape shell = ShapeWhere({ 9, 9, 9 }, [](int x, int y, int z) {
    return std::min({ x, y, z, 8 - x, 8 - y, 8 - z }) < 2;
  });
  for (const VoxelShape & shape :
       { Box({ 1, 1, 1 }), Box({ 1, 1, 12 }), Box({ 9, 9, 1 }), Box({ 9, 9, 2 }), touching, shell, Box({ 8, 8, 8 }) })
  {
    for (const double threshold : { 0.0, 1.5, 4.0 })
    {
      ExpectGuarded(Refine(shape, { 1, 1, 1 }, threshold), shape, { 1, 1, 1 });
      ExpectGuarded(Refine(shape, { 1, 1, 2.5 }, threshold), shape, { 1, 1, 2.5 });
    }
  }
  EXPECT_EQ(Refine(VoxelShape(), { 1, 1, 1 }, 1.5).core.cells.vertexCount, 0U);
}

// Thick enough for every pass of smoothing, with grooves that a smooth surface would pass by.
TEST(RefineCore, HoldsItsPromisesOnThickShapesWithGrooves)
{
  for (const Spacing3 & spacing : { Spacing3{ 1, 1, 1 }, Spacing3{ 0.8, 0.8, 1.6 } })
  {
    constexpr double centre = 18;
    const auto       side = [&](std::size_t axis) { return static_cast<std::int32_t>(2 * centre / spacing[axis]); };
    const VoxelShape shape = ShapeWhere({ side(0), side(1), side(2) }, [&](int x, int y, int z) {
      const double distance =
        std::hypot((x + 0.5) * spacing[0] - centre, (y + 0.5) * spacing[1] - centre, (z + 0.5) * spacing[2] - centre);
      return distance <= 15 && (distance <= 12.5 || (x % 9 != 0 && (x + 2 * y) % 13 != 0));
    });
    ExpectGuarded(Refine(shape, spacing, 4), shape, spacing);
  }
}

void
ExpectCovered(const RefinedCore & refined, const VoxelShape & shape, const Spacing3 & spacing, double height)
{
  for (const LatticePoint & q : BoundaryVertices(shape))
  {
    double least = 1e9;
    for (std::size_t vertex = 0; vertex < refined.core.radius.size(); ++vertex)
    {
      const Vector3 & p = refined.core.positions[vertex];
      least = std::min(least,
                       std::hypot(spacing[0] * (p[0] - q.x), spacing[1] * (p[1] - q.y), spacing[2] * (p[2] - q.z)) -
                         refined.core.radius[vertex]);
    }
    ASSERT_LE(least, height + 1e-6) << q.x << ' ' << q.y << ' ' << q.z;
  }
}

/** A rod with round ends that lies obliquely, thin in voxels. */
VoxelShape
ThinRod(const Spacing3 & spacing, double radius)
{
  const Vector3 way{ 0.48, 0.6, 0.64 };
  const auto    side = [&](std::size_t axis) { return static_cast<std::int32_t>(20 / spacing[axis]); };
  return ShapeWhere({ side(0), side(1), side(2) }, [&](int x, int y, int z) {
    const Vector3 from{ (x + 0.5) * spacing[0] - 10, (y + 0.5) * spacing[1] - 10, (z + 0.5) * spacing[2] - 10 };
    const double  along = std::clamp(from[0] * way[0] + from[1] * way[1] + from[2] * way[2], -8.0, 8.0);
    return std::hypot(from[0] - along * way[0], from[1] - along * way[1], from[2] - along * way[2]) <= radius;
  });
}

// Refined balls of thin parts would draw back from ends and rims, and become smaller, by up to a voxel each.
TEST(RefineCore, KeepsTheBoundaryWithinTheToleranceOrHalfADiagonal)
{
  for (const Spacing3 & spacing : { Spacing3{ 1, 1, 1 }, Spacing3{ 0.6, 0.6, 1.5 } })
  {
    const double diagonal = std::hypot(spacing[0], spacing[1], spacing[2]);
    for (const double height : { 0.0, 0.7 * diagonal, 1.2 * diagonal })
    {
      for (const double radius : { 1.1, 1.6, 2.4 })
      {
        SCOPED_TRACE(std::to_string(height) + ", radius " + std::to_string(radius));
        const VoxelShape  rod = ThinRod(spacing, radius);
        const RefinedCore refined = RefineByTolerance(rod, spacing, height);
        ExpectGuarded(refined, rod, spacing);
        ExpectCovered(refined, rod, spacing, std::max(height, 0.5 * diagonal));
      }
    }
  }
  for (const RandomVolume & volume : RandomVolumes(5200, 40))
  {
    SCOPED_TRACE(volume.Describe());
    const double      diagonal = std::hypot(volume.spacing[0], volume.spacing[1], volume.spacing[2]);
    const RefinedCore refined = RefineByTolerance(volume.shape, volume.spacing, diagonal);
    ExpectGuarded(refined, volume.shape, volume.spacing);
    ExpectCovered(refined, volume.shape, volume.spacing, diagonal);
  }
}

TEST(RefineCore, IsTheSameBitsForAnyNumberOfThreads)
{
  const VoxelShape rod = ThinRod({ 0.4, 0.4, 1 }, 1.2);
  const int        threads = omp_get_max_threads();
  const VoxelShape shape = Ellipsoid(40);
  omp_set_num_threads(1);
  const RefinedCore one = Refine(shape, { 1, 1, 1 }, 2);
  const RefinedCore thin = RefineByTolerance(rod, { 0.4, 0.4, 1 }, 1);
  for (const int count : { 2, 3 })
  {
    omp_set_num_threads(count);
    const RefinedCore otherThin = RefineByTolerance(rod, { 0.4, 0.4, 1 }, 1);
    EXPECT_EQ(thin.core.positions, otherThin.core.positions);
    EXPECT_EQ(thin.core.radius, otherThin.core.radius);
    const RefinedCore other = Refine(shape, { 1, 1, 1 }, 2);
    EXPECT_EQ(one.core.positions, other.core.positions);
    EXPECT_EQ(one.displacement, other.displacement);
    EXPECT_EQ(one.core.radius, other.core.radius);
    EXPECT_EQ(one.core.vertexLambda, other.core.vertexLambda);
    EXPECT_EQ(one.core.faceLambda, other.core.faceLambda);
    EXPECT_EQ(one.core.cells.faceVertices, other.core.cells.faceVertices);
  }
  omp_set_num_threads(threads);
}

} // namespace
} // namespace voxelcore::testing
