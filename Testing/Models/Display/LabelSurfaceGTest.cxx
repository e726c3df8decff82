// The surface that is drawn of a label lies where its voxels lie.

#include "VoxelCoreTesting/Shapes.h"
#include "voxelcore/Display/LabelSurface.h"
#include "voxelcore/VoxelCore/LambdaPruning.h"
#include "voxelcore/VoxelCore/VoxelCore.h"

#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <numbers>

namespace voxelcore::testing
{
namespace
{

/** Oblique, and left-handed when `mirrored`. */
ImageGeometry
Oblique(bool mirrored)
{
  ImageGeometry geometry;
  geometry.size = { 64, 64, 64 };
  geometry.spacing = { 0.5, 0.8, 2 };
  geometry.origin = { -31, 12, 7 };
  const double c = std::cos(0.7);
  const double s = std::sin(0.7);
  const double sign = mirrored ? -1 : 1;
  geometry.direction = { c, -s, 0, s, c, 0, 0, 0, sign };
  return geometry;
}

/** By the divergence theorem: positive when triangles are seen counter-clockwise from outside. */
double
Volume(const LabelSurfaceMesh & mesh)
{
  double volume = 0;
  for (const auto & t : mesh.triangles)
  {
    const auto & a = mesh.points[t[0]];
    const auto & b = mesh.points[t[1]];
    const auto & c = mesh.points[t[2]];
    volume +=
      (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])) /
      6.0;
  }
  return volume;
}

TEST(LabelSurface, HasTheVolumeOfTheVoxelsWhateverTheAxes)
{
  const VoxelShape shape = Ellipsoid(48);
  const double     voxels = static_cast<double>(shape.CountVoxels()) * 0.5 * 0.8 * 2;
  for (const bool mirrored : { false, true })
  {
    EXPECT_NEAR(Volume(LabelSurface(shape, Oblique(mirrored))) / voxels, 1, 0.03) << mirrored;
  }
}

TEST(LabelSurface, StaysWithinAVoxelOfTheBoundary)
{
  const VoxelShape    shape = Ellipsoid(32);
  const ImageGeometry geometry = Oblique(true);
  for (const auto & point : LabelSurface(shape, geometry).points)
  {
    const Vector3 lattice = PhysicalToLattice(geometry, { point[0], point[1], point[2] });
    bool          near[2] = { false, false };
    for (int code = 0; code < 27; ++code)
    {
      const int x = static_cast<int>(std::floor(lattice[0])) + code % 3 - 1;
      const int y = static_cast<int>(std::floor(lattice[1])) + code / 3 % 3 - 1;
      const int z = static_cast<int>(std::floor(lattice[2])) + code / 9 - 1;
      near[shape.Contains(x, y, z) ? 1 : 0] = true;
    }
    ASSERT_TRUE(near[0] && near[1]) << lattice[0] << ' ' << lattice[1] << ' ' << lattice[2];
  }
}

/** How often the mesh goes around a point: the solid angles of its triangles (van Oosterom and Strackee) over the
 *  sphere. */
double
WindingNumber(const LabelSurfaceMesh & mesh, const Vector3 & point)
{
  double angle = 0;
  for (const auto & t : mesh.triangles)
  {
    std::array<Vector3, 3> r{};
    std::array<double, 3>  length{};
    for (std::size_t k = 0; k < 3; ++k)
    {
      for (std::size_t a = 0; a < 3; ++a)
      {
        r[k][a] = mesh.points[t[k]][a] - point[a];
      }
      length[k] = std::hypot(r[k][0], r[k][1], r[k][2]);
    }
    const auto   dot = [&](int i, int j) { return r[i][0] * r[j][0] + r[i][1] * r[j][1] + r[i][2] * r[j][2]; };
    const double volume = r[0][0] * (r[1][1] * r[2][2] - r[1][2] * r[2][1]) -
                          r[0][1] * (r[1][0] * r[2][2] - r[1][2] * r[2][0]) +
                          r[0][2] * (r[1][0] * r[2][1] - r[1][1] * r[2][0]);
    angle += 2 * std::atan2(volume,
                            length[0] * length[1] * length[2] + dot(0, 1) * length[2] + dot(0, 2) * length[1] +
                              dot(1, 2) * length[0]);
  }
  return angle / (4 * std::numbers::pi);
}

TEST(LabelSurface, HasTheMedialSurfaceInsideItWhateverTheAxes)
{
  const VoxelShape shape = Ellipsoid(40);
  for (const bool mirrored : { false, true })
  {
    const ImageGeometry geometry = Oblique(mirrored);
    ASSERT_EQ(IsLeftHanded(geometry), mirrored);
    const LabelSurfaceMesh surface = LabelSurface(shape, geometry);
    const auto             weights = ComputeSpacingWeights(geometry.spacing);
    const auto             pruned = PruneByLambda(ComputeVoxelCore(shape, weights), { 1.5 });
    const ModelPart        medial = ToPhysical(pruned.front(), geometry, 1);
    ASSERT_GT(medial.core.positions.size(), 100U);
    for (const Vector3 & point : medial.core.positions)
    {
      const Vector3 lattice = PhysicalToLattice(geometry, point);
      ASSERT_TRUE(shape.Contains(static_cast<int>(std::floor(lattice[0])),
                                 static_cast<int>(std::floor(lattice[1])),
                                 static_cast<int>(std::floor(lattice[2]))));
      ASSERT_NEAR(WindingNumber(surface, point), 1, 1e-3) << mirrored;
    }
    // The measure can tell: the same point in the other handedness lies elsewhere.
    const Vector3 lattice = PhysicalToLattice(geometry, medial.core.positions.front());
    ASSERT_NEAR(WindingNumber(surface, LatticeToPhysical(Oblique(!mirrored), lattice)), 0, 1e-3);
  }
}

TEST(LabelSurface, IsClosedAndOfTheSmallestShapesToo)
{
  for (const VoxelShape & shape : { Box({ 1, 1, 1 }), Box({ 5, 1, 1 }, { 3, 2, 9 }), Box({ 4, 4, 4 }) })
  {
    const LabelSurfaceMesh                                 mesh = LabelSurface(shape, Oblique(false));
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const auto & t : mesh.triangles)
    {
      for (std::size_t k = 0; k < 3; ++k)
      {
        ++edges[{ t[k], t[(k + 1) % 3] }];
      }
    }
    EXPECT_FALSE(mesh.triangles.empty());
    for (const auto & [edge, count] : edges)
    {
      EXPECT_EQ(count, 1);
      EXPECT_EQ(edges.count({ edge.second, edge.first }), 1U);
    }
    EXPECT_GT(Volume(mesh), 0);
  }
  EXPECT_TRUE(LabelSurface(VoxelShape(), Oblique(false)).points.empty());
}

} // namespace
} // namespace voxelcore::testing
