#include "Uses/Meshes/MeshFixtures.h"

#include "voxelcore/Lattice/TriangleMesh.h"
#include "voxelcore/Lattice/Vectors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numeric>

namespace voxelcore::testing
{
namespace
{

const VoxelGrid kGrid{ { 0, 0, 0 }, { 1, 1, 1 }, { 40, 40, 40 } };

/** Of the body that is on the inner side of all triangles: below 0 where they are inside out. */
double
SignedVolume(const TriangleMesh & mesh)
{
  double volume = 0;
  for (const auto & t : mesh.triangles)
  {
    const Vector3 & a = mesh.points[t[0]];
    const Vector3 & b = mesh.points[t[1]];
    const Vector3 & c = mesh.points[t[2]];
    volume +=
      (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])) /
      6;
  }
  return volume;
}

TriangleMesh
InsideOut(TriangleMesh mesh)
{
  for (auto & triangle : mesh.triangles)
  {
    std::swap(triangle[0], triangle[1]);
  }
  return mesh;
}

/** Every voxel of the grid: in or not. */
std::vector<bool>
VoxelsOf(const VoxelShape & shape)
{
  std::vector<bool> voxels;
  for (std::int32_t z = 0; z < kGrid.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < kGrid.size[1]; ++y)
    {
      for (std::int32_t x = 0; x < kGrid.size[0]; ++x)
      {
        voxels.push_back(shape.Contains(x, y, z));
      }
    }
  }
  return voxels;
}

TEST(TriangleMesh, CornersRunCounterClockwiseSeenFromOutside)
{
  std::mt19937 random(20261122);
  EXPECT_DOUBLE_EQ(SignedVolume(BoxMesh({ 1, 2, 3 }, { 5, 7, 9 })), 4 * 5 * 6);
  for (const TriangleMesh & mesh : { BoxMesh({ 3.2, 4.1, 5.3 }, { 33.7, 29.2, 31.9 }),
                                     StarMesh({ 20, 20, 20 }, 17, 12, 0.3, random),
                                     TorusMesh({ 20, 20, 20 }, 12, 5, 40, 20) })
  {
    const Voxelization body = Voxelize(mesh, kGrid);
    EXPECT_NEAR(SignedVolume(mesh), static_cast<double>(body.voxels), 0.03 * SignedVolume(mesh));
    EXPECT_EQ(body.doubtful, 0U);
    EXPECT_EQ(body.findings.flipped, 0U);
    const Voxelization turned = Voxelize(InsideOut(mesh), kGrid);
    EXPECT_EQ(VoxelsOf(turned.shape), VoxelsOf(body.shape));
    EXPECT_EQ(turned.doubtful, 0U) << "a mesh that is inside out as a whole is clear";
  }
  const Voxelization both =
    Voxelize(Together(BoxMesh({ 1, 1, 1 }, { 20, 20, 20 }), BoxMesh({ 25, 25, 25 }, { 30, 30, 30 }), true), kGrid);
  EXPECT_EQ(both.voxels, 19U * 19 * 19 + 125);
  EXPECT_EQ(both.doubtful, 125U) << "a part that is inside out beside one that is not";
}

TEST(TriangleMesh, NumbersOfPointsAndTheOrderOfTrianglesDoNotMatter)
{
  constexpr unsigned seed = 1122;
  std::cout << "seed " << seed << '\n';
  std::mt19937       random(seed);
  const TriangleMesh mesh = StarMesh({ 19.5, 20.5, 20.25 }, 15, 10, 0.5, random);
  const Voxelization whole = Voxelize(mesh, kGrid);
  for (int round = 0; round < 5; ++round)
  {
    // Each point there up to three times, under any number.
    std::vector<std::uint32_t> original;
    for (std::uint32_t point = 0; point < mesh.points.size(); ++point)
    {
      original.insert(original.end(), 1 + random() % 3, point);
    }
    std::shuffle(original.begin(), original.end(), random);
    TriangleMesh other;
    for (const std::uint32_t point : original)
    {
      other.points.push_back(mesh.points[point]);
    }
    other.points.push_back({ 39, 39, 39 }); // that no triangle has
    const auto anyOf = [&](std::uint32_t point) {
      const auto start = random() % original.size();
      for (std::size_t i = 0;; ++i)
      {
        const std::size_t at = (start + i) % original.size();
        if (original[at] == point)
        {
          return static_cast<std::uint32_t>(at);
        }
      }
    };
    for (const auto & t : mesh.triangles)
    {
      std::array<std::uint32_t, 3> corners{ anyOf(t[0]), anyOf(t[1]), anyOf(t[2]) };
      std::rotate(corners.begin(), corners.begin() + random() % 3, corners.end());
      other.triangles.push_back(corners);
    }
    std::shuffle(other.triangles.begin(), other.triangles.end(), random);
    const Voxelization result = Voxelize(other, kGrid);
    EXPECT_EQ(VoxelsOf(result.shape), VoxelsOf(whole.shape)) << "round " << round;
    EXPECT_EQ(result.findings.pieces, 1U);
    EXPECT_EQ(result.findings.openEdges, 0U);
    EXPECT_EQ(result.doubtful, 0U);
  }
}

} // namespace
} // namespace voxelcore::testing
