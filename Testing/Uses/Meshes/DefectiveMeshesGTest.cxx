// Meshes as they come: with holes, turned faces, doubled faces, parts in parts.

#include "MeshFixtures.h"
#include "VoxelCoreTesting/Messages.h"

#include <gtest/gtest.h>
#include <random>

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

const VoxelGrid kGrid{ { 0, 0, 0 }, { 1, 1, 1 }, { 24, 24, 24 } };

TriangleMesh
Ball(int rings = 12)
{
  std::mt19937 random(1);
  return StarMesh({ 12.1, 11.9, 12.05 }, 10, rings, 0, random);
}

std::uint64_t
Differences(const VoxelShape & a, const VoxelShape & b)
{
  std::uint64_t count = 0;
  for (std::int32_t z = 0; z < kGrid.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < kGrid.size[1]; ++y)
    {
      for (std::int32_t x = 0; x < kGrid.size[0]; ++x)
      {
        count += a.Contains(x, y, z) != b.Contains(x, y, z) ? 1 : 0;
      }
    }
  }
  return count;
}

} // namespace

TEST(DefectiveMeshes, TurnedFacesAreTurnedBack)
{
  const Voxelization whole = Voxelize(Ball(), kGrid);
  TriangleMesh       mesh = Ball();
  std::mt19937       random(3);
  std::size_t        turned = 0;
  for (auto & t : mesh.triangles)
  {
    if (random() % 3 == 0)
    {
      std::swap(t[0], t[1]);
      ++turned;
    }
  }
  const Voxelization result = Voxelize(mesh, kGrid);
  EXPECT_EQ(result.findings.flipped, turned);
  EXPECT_EQ(result.findings.rule, InsideRule::Winding);
  EXPECT_EQ(Differences(result.shape, whole.shape), 0U);
  EXPECT_EQ(result.doubtful, 0U);
}

TEST(DefectiveMeshes, DoubledFacesCountOnce)
{
  const Voxelization whole = Voxelize(Ball(), kGrid);
  for (const bool reversed : { false, true })
  {
    TriangleMesh mesh = Ball();
    for (std::size_t t = 0; t < 40; ++t)
    {
      auto copy = mesh.triangles[t];
      if (reversed)
      {
        std::swap(copy[0], copy[1]);
      }
      mesh.triangles.push_back(copy);
    }
    const Voxelization result = Voxelize(mesh, kGrid);
    EXPECT_EQ(result.findings.duplicates, 40U);
    EXPECT_EQ(Differences(result.shape, whole.shape), 0U);
  }
  EXPECT_EQ(Differences(Voxelize(Together(Ball(), Ball()), kGrid).shape, whole.shape), 0U) << "all of it twice";
}

TEST(DefectiveMeshes, TrianglesWithoutAreaAndPointsThatAreThereTwiceDoNotMatter)
{
  const Voxelization whole = Voxelize(Ball(), kGrid);
  TriangleMesh       soup;
  for (const auto & t : Ball().triangles)
  {
    for (const std::uint32_t corner : t)
    {
      soup.points.push_back(Ball().points[corner]);
    }
    const auto last = static_cast<std::uint32_t>(soup.points.size());
    soup.triangles.push_back({ last - 3, last - 2, last - 1 });
  }
  soup.triangles.push_back({ 0, 0, 1 });
  const Voxelization result = Voxelize(soup, kGrid);
  EXPECT_EQ(result.findings.degenerate, 1U);
  EXPECT_EQ(result.findings.pieces, 1U);
  EXPECT_EQ(result.findings.openEdges, 0U);
  EXPECT_EQ(Differences(result.shape, whole.shape), 0U);
}

TEST(DefectiveMeshes, PointsOfNoTriangleDoNotMatterHoweverFarTheyLie)
{
  const Voxelization whole = Voxelize(Ball(), kGrid);
  for (const double far : { 1e30, 1e60, 1.7e308 })
  {
    TriangleMesh mesh = Ball();
    mesh.points.push_back({ -far, far, far });
    EXPECT_EQ(Differences(Voxelize(mesh, kGrid).shape, whole.shape), 0U) << far;
  }
}

TEST(DefectiveMeshes, SmallHolesAreVotedShut)
{
  const Voxelization whole = Voxelize(Ball(), kGrid);
  TriangleMesh       mesh = Ball();
  std::mt19937       random(4);
  for (int hole = 0; hole < 6; ++hole)
  {
    mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(random() % mesh.triangles.size()));
  }
  const Voxelization result = Voxelize(mesh, kGrid);
  EXPECT_EQ(result.findings.rule, InsideRule::Votes);
  EXPECT_GE(result.findings.openEdges, 12U);
  EXPECT_GT(result.doubtful, 0U);
  EXPECT_LT(result.doubtful, whole.voxels / 2);
  EXPECT_LE(Differences(result.shape, whole.shape), whole.voxels / 100);
}

TEST(DefectiveMeshes, ABoxWithoutALidIsStillABox)
{
  TriangleMesh mesh = BoxMesh({ 2, 3, 4 }, { 12, 13, 14 });
  mesh.triangles.resize(10);
  const Voxelization result = Voxelize(mesh, kGrid);
  EXPECT_EQ(result.voxels, 1000U);
  // Of the six rays one misses the lid from inside. Over it and under the floor one meets the floor alone.
  EXPECT_EQ(result.doubtful, 1000U + 100U * (24 - 14) + 100U * 4);
}

TEST(DefectiveMeshes, VotesOfAClosedSurfaceAreUnanimousAndExact)
{
  // A second part with a hole makes all of it a matter of votes; the first must come out as it does by itself.
  const TriangleMesh box = BoxMesh({ 1.5, 1.5, 1.5 }, { 8.5, 9.5, 7.5 });
  TriangleMesh       open = OctahedronMesh({ 17.5, 17.5, 17.5 }, 5);
  open.triangles.pop_back();
  const Voxelization alone = Voxelize(box, kGrid);
  const Voxelization both = Voxelize(Together(box, open), kGrid);
  EXPECT_EQ(both.findings.rule, InsideRule::Votes);
  for (std::int32_t z = 0; z < 9; ++z)
  {
    for (std::int32_t y = 0; y < 11; ++y)
    {
      for (std::int32_t x = 0; x < 10; ++x)
      {
        ASSERT_EQ(both.shape.Contains(x, y, z), alone.shape.Contains(x, y, z)) << x << " " << y << " " << z;
      }
    }
  }
}

TEST(DefectiveMeshes, OverlappingPartsAreOneAndSaidToBeDoubtful)
{
  const Voxelization result =
    Voxelize(Together(BoxMesh({ 2, 2, 2 }, { 12, 12, 12 }), BoxMesh({ 8, 8, 8 }, { 18, 18, 18 })), kGrid);
  EXPECT_EQ(result.voxels, 1000U + 1000U - 64U);
  EXPECT_EQ(result.doubtful, 64U);
}

TEST(DefectiveMeshes, APartWithinIsACavityOnlyWhenItIsInsideOut)
{
  const TriangleMesh outer = BoxMesh({ 2, 2, 2 }, { 12, 12, 12 });
  const TriangleMesh inner = BoxMesh({ 5, 5, 5 }, { 8, 8, 8 });
  const Voxelization cavity = Voxelize(Together(outer, inner, true), kGrid);
  EXPECT_EQ(cavity.voxels, 1000U - 27U);
  EXPECT_EQ(cavity.doubtful, 0U);
  const Voxelization solid = Voxelize(Together(outer, inner), kGrid);
  EXPECT_EQ(solid.voxels, 1000U);
  EXPECT_EQ(solid.doubtful, 27U);
}

TEST(DefectiveMeshes, AClosedSurfaceOfNoOrientationIsDecidedByParity)
{
  // The projective plane as a polyhedron of four triangles and three squares that cross each other: each edge lies on
  // two faces, and it has no orientation. Its four open octants are in by parity.
  const TriangleMesh octahedron = OctahedronMesh({ 12.1, 12.2, 12.3 }, 10);
  TriangleMesh       mesh{ octahedron.points, {} };
  for (const auto & t : { std::array<std::uint32_t, 3>{ 0, 2, 4 }, { 0, 3, 5 }, { 1, 2, 5 }, { 1, 3, 4 } })
  {
    mesh.triangles.push_back(t);
  }
  for (const auto & square : { std::array<std::uint32_t, 4>{ 0, 2, 1, 3 }, { 4, 1, 5, 0 }, { 2, 4, 3, 5 } })
  {
    mesh.triangles.push_back({ square[0], square[1], square[2] });
    mesh.triangles.push_back({ square[0], square[2], square[3] });
  }
  const Voxelization result = Voxelize(mesh, kGrid);
  EXPECT_EQ(result.findings.rule, InsideRule::Parity);
  EXPECT_EQ(result.findings.openEdges, 0U);
  const VoxelShape whole = Voxelize(octahedron, kGrid).shape;
  for (std::int32_t z = 0; z < 24; ++z)
  {
    for (std::int32_t y = 0; y < 24; ++y)
    {
      for (std::int32_t x = 0; x < 24; ++x)
      {
        const int  below = (x + 0.5 < 12.1 ? 1 : 0) + (y + 0.5 < 12.2 ? 1 : 0) + (z + 0.5 < 12.3 ? 1 : 0);
        const bool expected = below % 2 == 0 && whole.Contains(x, y, z);
        ASSERT_EQ(result.shape.Contains(x, y, z), expected) << x << " " << y << " " << z;
      }
    }
  }
}

TEST(DefectiveMeshes, WhatBoundsNothingIsRefused)
{
  const TriangleMesh one{ { { 1, 1, 1 }, { 20, 2, 3 }, { 3, 20, 12 } }, { { 0, 1, 2 } } };
  EXPECT_NE(MessageOf([&] { Voxelize(one, kGrid); }).find("bounds nothing"), std::string::npos);
  TriangleMesh sheet = one;
  sheet.points.push_back({ 22, 22, 14 });
  sheet.triangles.push_back({ 1, 3, 2 });
  EXPECT_NE(MessageOf([&] { Voxelize(sheet, kGrid); }).find("bounds nothing"), std::string::npos);
  TriangleMesh flat = one;
  flat.triangles.push_back({ 0, 2, 1 });
  EXPECT_NE(MessageOf([&] { Voxelize(flat, kGrid); }).find("no voxel's centre"), std::string::npos);
  EXPECT_NE(MessageOf([&] {
              Voxelize(BoxMesh({ 2.6, 2.6, 2.6 }, { 3.4, 3.4, 3.4 }), kGrid);
            }).find("no voxel's centre"),
            std::string::npos);
  EXPECT_NE(MessageOf([&] { GridOfResolution({ { { 1, 1, 1 } }, {} }, 10); }).find("no triangles"), std::string::npos);
  EXPECT_NE(MessageOf([&] {
              Voxelize({ { { 1, 1, 1 } }, { { 0, 0, 0 } } }, kGrid);
            }).find("bounds nothing"),
            std::string::npos);
}

TEST(DefectiveMeshes, CapsCloseHolesWhereverTheyAre)
{
  const TriangleMesh box = BoxMesh({ 2, 2, 2 }, { 12, 12, 12 });
  const VoxelShape   expected = Voxelize(box, kGrid).shape;
  TriangleMesh       closed = box;
  EXPECT_EQ(CapHoles(closed), 0U);
  EXPECT_EQ(closed.triangles.size(), box.triangles.size());
  // A tube: without the two sides along an axis no ray along it tells.
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    TriangleMesh tube = box;
    std::erase_if(tube.triangles, [&](const auto & t) {
      return tube.points[t[0]][axis] == tube.points[t[1]][axis] && tube.points[t[0]][axis] == tube.points[t[2]][axis];
    });
    ASSERT_EQ(tube.triangles.size(), 8U);
    EXPECT_NE(MessageOf([&] { Voxelize(tube, kGrid); }).find("--cap"), std::string::npos);
    EXPECT_EQ(CapHoles(tube), 2U);
    const Voxelization capped = Voxelize(tube, kGrid);
    EXPECT_EQ(capped.findings.rule, InsideRule::Winding);
    EXPECT_EQ(capped.findings.openEdges, 0U);
    EXPECT_EQ(Differences(capped.shape, expected), 0U);
  }
  // Two holes that meet at a corner, and triangles with points of their own, as STL has them.
  TriangleMesh soup;
  const auto & first = box.triangles[0];
  const auto   second = std::find_if(box.triangles.begin(), box.triangles.end(), [&](const auto & t) {
    return std::count_if(t.begin(), t.end(), [&](std::uint32_t corner) {
             return std::find(first.begin(), first.end(), corner) != first.end();
           }) == 1;
  });
  ASSERT_NE(second, box.triangles.end());
  for (const auto & t : box.triangles)
  {
    if (&t == &first || &t == &*second)
    {
      continue;
    }
    const auto next = static_cast<std::uint32_t>(soup.points.size());
    for (const std::uint32_t corner : t)
    {
      soup.points.push_back(box.points[corner]);
    }
    soup.triangles.push_back({ next, next + 1, next + 2 });
  }
  EXPECT_EQ(CapHoles(soup), 2U);
  EXPECT_EQ(Differences(Voxelize(soup, kGrid).shape, expected), 0U);
}

TEST(DefectiveMeshes, AFinOnABoxAndAWallInItChangeNothing)
{
  const TriangleMesh box = BoxMesh({ 2, 2, 2 }, { 12, 12, 12 });
  const VoxelShape   expected = Voxelize(box, kGrid).shape;
  TriangleMesh       fin = box;
  fin.points.push_back({ 20, 20, 20 });
  fin.triangles.push_back({ 0, 1, 8 });
  const Voxelization withFin = Voxelize(fin, kGrid);
  EXPECT_EQ(withFin.findings.rule, InsideRule::Votes);
  EXPECT_EQ(withFin.findings.openEdges, 3U);
  EXPECT_GT(withFin.doubtful, 0U);
  EXPECT_EQ(Differences(withFin.shape, expected), 0U);
  // Two rooms with a wall between them: three sheets meet at its edges.
  TriangleMesh rooms = BoxMesh({ 2, 2, 2 }, { 12, 12, 7 });
  const auto   other = BoxMesh({ 2, 2, 7 }, { 12, 12, 12 });
  for (const auto & t : other.triangles)
  {
    const auto isInWall = [&](std::uint32_t corner) { return other.points[corner][2] == 7; };
    if (!isInWall(t[0]) || !isInWall(t[1]) || !isInWall(t[2]))
    {
      rooms.triangles.push_back({ t[0] + 8, t[1] + 8, t[2] + 8 });
    }
  }
  rooms.points.insert(rooms.points.end(), other.points.begin(), other.points.end());
  const Voxelization withWall = Voxelize(rooms, kGrid);
  EXPECT_EQ(withWall.findings.openEdges, 4U);
  EXPECT_EQ(Differences(withWall.shape, expected), 0U);
}

TEST(DefectiveMeshes, NumbersThatAreNoneAreRefused)
{
  TriangleMesh mesh = Ball();
  mesh.points[5][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(MessageOf([&] { GridOfResolution(mesh, 20); }).find("finite"), std::string::npos);
  mesh.points[5][1] = 1e12;
  EXPECT_NE(MessageOf([&] { GridOfResolution(mesh, 20); }).find("1e9"), std::string::npos);
  EXPECT_THROW(GridOfResolution(Ball(), 0), UsageError);
  EXPECT_THROW(GridOfSpacing(Ball(), { 1, 0, 1 }), UsageError);
  EXPECT_THROW(GridOfSpacing(Ball(), { 1e-6, 1, 1 }), InputError);
}
