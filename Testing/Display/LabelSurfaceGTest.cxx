// The surface that is drawn of a label lies where its voxels lie.

#include "VoxelCoreTesting/Shapes.h"
#include "voxelcore/DisplayContent.h"

#include <cmath>
#include <gtest/gtest.h>
#include <map>

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
Volume(const TriangleMesh & mesh)
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

TEST(LabelSurface, IsClosedAndOfTheSmallestShapesToo)
{
  for (const VoxelShape & shape : { Box({ 1, 1, 1 }), Box({ 5, 1, 1 }, { 3, 2, 9 }), Box({ 4, 4, 4 }) })
  {
    const TriangleMesh                                     mesh = LabelSurface(shape, Oblique(false));
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
