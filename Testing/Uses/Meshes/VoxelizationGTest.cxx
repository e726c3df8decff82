#include "voxelcore/Meshes/Voxelization.h"

#include "ExactWinding.h"
#include "MeshFixtures.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Shape/ShapeTopology.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <omp.h>
#include <random>
#include <set>

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

/** Compares `centres` random centres of each mesh; a third of them near the surface, where the voxels change. */
void
CompareWithBruteForce(unsigned seed, int centres)
{
  const auto cases = ClosedMeshes(seed);
  ASSERT_EQ(cases.size(), 30U);
  for (const MeshCase & one : cases)
  {
    SCOPED_TRACE(one.name + ", seed " + std::to_string(seed));
    const Voxelization                       result = Voxelize(one.mesh, one.grid);
    const ExactWinding                       exact(one.mesh, one.grid);
    std::vector<std::array<std::int32_t, 3>> places(static_cast<std::size_t>(centres));
    std::mt19937                             random(seed);
    for (std::size_t n = 0; n < places.size(); ++n)
    {
      auto & place = places[n];
      for (int attempt = 0; attempt < 100; ++attempt)
      {
        for (std::size_t a = 0; a < 3; ++a)
        {
          place[a] = std::uniform_int_distribution<std::int32_t>(0, one.grid.size[a] - 1)(random);
        }
        const bool in = result.shape.Contains(place[0], place[1], place[2]);
        if (n % 3 != 0 || in != result.shape.Contains(place[0] + 1, place[1], place[2]) ||
            in != result.shape.Contains(place[0], place[1] - 1, place[2]))
        {
          break;
        }
      }
    }
    int differences = 0;
#pragma omp parallel for reduction(+ : differences)
    for (int n = 0; n < centres; ++n)
    {
      const auto & p = places[static_cast<std::size_t>(n)];
      differences += (exact.At(p, static_cast<std::size_t>(n) % 3) != 0) != result.shape.Contains(p[0], p[1], p[2]);
    }
    EXPECT_EQ(differences, 0);
    EXPECT_EQ(result.findings.rule, InsideRule::Winding);
  }
}

std::uint64_t
VoxelsOf(const TriangleMesh & mesh, const VoxelGrid & grid)
{
  return Voxelize(mesh, grid).voxels;
}

const VoxelGrid kTen{ { 0, 0, 0 }, { 1, 1, 1 }, { 10, 10, 10 } };

} // namespace

TEST(Voxelization, IsTheBruteForceWindingNumbersAtRandomCentres)
{
  CompareWithBruteForce(1, 1700);
}

TEST(HeavyVoxelization, IsTheBruteForceWindingNumbersAtAMillionCentres)
{
  CompareWithBruteForce(2, 33400);
}

TEST(Voxelization, CentresOnTheSurfaceAreDecidedAsIfMovedUpwards)
{
  // Faces on the centres of voxels 2 and 7: those of 2 move in, those of 7 move out.
  const Voxelization result = Voxelize(BoxMesh({ 2.5, 2.5, 2.5 }, { 7.5, 7.5, 7.5 }), kTen);
  EXPECT_EQ(result.voxels, 125U);
  EXPECT_EQ(result.shape.Box().lower, (std::array<std::int32_t, 3>{ 2, 2, 2 }));
  EXPECT_EQ(result.shape.Box().size, (std::array<std::int32_t, 3>{ 5, 5, 5 }));
  EXPECT_EQ(result.doubtful, 0U);
}

TEST(Voxelization, ShapesThatFillSpaceShareEachCentreOnce)
{
  // A box cut by a slanted plane through centres: each centre belongs to exactly one of the two wedges.
  const Vector3 p[8] = { { 1.5, 1.5, 1.5 }, { 8.5, 1.5, 1.5 }, { 1.5, 8.5, 1.5 }, { 8.5, 8.5, 1.5 },
                         { 1.5, 1.5, 8.5 }, { 8.5, 1.5, 8.5 }, { 1.5, 8.5, 8.5 }, { 8.5, 8.5, 8.5 } };
  TriangleMesh  low{
    { p, p + 8 },
    { { 0, 2, 1 }, { 4, 5, 6 }, { 0, 1, 5 }, { 0, 5, 4 }, { 0, 4, 6 }, { 0, 6, 2 }, { 1, 2, 6 }, { 1, 6, 5 } }
  };
  TriangleMesh high{
    { p, p + 8 },
    { { 1, 2, 3 }, { 5, 7, 6 }, { 1, 3, 7 }, { 1, 7, 5 }, { 2, 6, 7 }, { 2, 7, 3 }, { 1, 6, 2 }, { 1, 5, 6 } }
  };
  EXPECT_EQ(VoxelsOf(low, kTen) + VoxelsOf(high, kTen), 343U);
  EXPECT_EQ(VoxelsOf(Together(low, high), kTen), 343U);
}

TEST(Voxelization, ResolutionIsTheVoxelsOnTheLongestSide)
{
  const TriangleMesh mesh = BoxMesh({ -3, 10, 0.5 }, { 4, 13, 1.5 });
  const VoxelGrid    grid = GridOfResolution(mesh, 70);
  EXPECT_EQ(grid.size, (std::array<std::int32_t, 3>{ 70, 30, 10 }));
  EXPECT_EQ(grid.origin, (Vector3{ -3, 10, 0.5 }));
  EXPECT_EQ(VoxelsOf(mesh, grid), 21000U);
  EXPECT_EQ(GridOfSpacing(mesh, { 0.5, 0.5, 2 }).size, (std::array<std::int32_t, 3>{ 14, 6, 1 }));
  for (int n = 1; n < 200; ++n)
  {
    EXPECT_EQ(GridOfResolution(BoxMesh({ 0.1, 0.2, 0.3 }, { 0.8, 0.4, 0.5 }), n).size[0], n);
  }
}

TEST(Voxelization, DoesNotDependOnThreads)
{
  std::mt19937              random(5);
  TriangleMesh              mesh = Turned(TorusMesh({ 0, 0, 0 }, 10, 3, 60, 24), random);
  const VoxelGrid           grid = GridOfResolution(mesh, 100);
  const int                 before = omp_get_max_threads();
  std::vector<Voxelization> results;
  for (const bool isOpen : { false, true })
  {
    for (const int threads : { 1, 3 })
    {
      omp_set_num_threads(threads);
      results.push_back(Voxelize(mesh, grid));
    }
    const auto & one = results[results.size() - 2];
    const auto & other = results.back();
    ASSERT_EQ(one.shape.Box().size, other.shape.Box().size);
    EXPECT_EQ(one.doubtful, other.doubtful);
    for (std::int32_t z = 0; z < one.shape.Box().size[2]; ++z)
    {
      for (std::int32_t y = 0; y < one.shape.Box().size[1]; ++y)
      {
        const auto a = one.shape.Row(y, z);
        const auto b = other.shape.Row(y, z);
        ASSERT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end()));
      }
    }
    if (!isOpen)
    {
      mesh.triangles.resize(mesh.triangles.size() - 7);
    }
  }
  omp_set_num_threads(before);
}

TEST(Voxelization, CanBeCancelled)
{
  const TriangleMesh mesh = BoxMesh({ 0, 0, 0 }, { 1, 1, 1 });
  int                calls = 0;
  EXPECT_THROW(Voxelize(mesh, GridOfResolution(mesh, 300), [&](std::string_view, double) { return ++calls < 2; }),
               Cancelled);
}

TEST(Voxelization, WithCoverThinPartsStayInOnePiece)
{
  // A needle a tenth of a voxel thick and a sheet that leave a ball; of both no centre is in.
  constexpr unsigned seed = 11;
  std::mt19937       random(seed);
  for (int turn = 0; turn < 20; ++turn)
  {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", turn " + std::to_string(turn));
    TriangleMesh mesh = StarMesh({ 20, 20, 20 }, 5, 6, 0, random);
    const auto   add = [&](const Vector3 & a, const Vector3 & b, const Vector3 & c, const Vector3 & d) {
      const auto at = static_cast<std::uint32_t>(mesh.points.size());
      mesh.points.insert(mesh.points.end(), { a, b, c, d });
      for (const auto & t : { std::array{ 0U, 2U, 1U }, { 0U, 1U, 3U }, { 1U, 2U, 3U }, { 2U, 0U, 3U } })
      {
        mesh.triangles.push_back({ at + t[0], at + t[1], at + t[2] });
      }
    };
    add({ 20, 20, 20 }, { 20.1, 20, 20 }, { 20, 20.1, 20 }, { 38, 33, 36 });
    add({ 20, 20, 20 }, { 20, 20.05, 20.05 }, { 4, 6, 19 }, { 6, 22, 3 });
    mesh = Turned(std::move(mesh), random);
    VoxelGrid          grid = GridOfResolution(mesh, 40);
    const Voxelization plain = Voxelize(mesh, grid);
    const Voxelization covered = Voxelize(mesh, grid, {}, true);
    EXPECT_EQ(covered.voxels, plain.voxels + covered.touched);
    EXPECT_EQ(covered.voxels, covered.shape.CountVoxels());
    EXPECT_EQ(CountComponents26(covered.shape), 1);
    // Each place of the surface lies in a voxel, and each voxel that was added has one within half a voxel's diagonal
    // and the distance of places.
    std::set<std::array<std::int32_t, 3>> near;
    constexpr int                         steps = 400;
    for (const auto & corners : mesh.triangles)
    {
      for (int u = 0; u <= steps; ++u)
      {
        for (int v = 0; u + v <= steps; v += steps / 20)
        {
          std::array<std::int32_t, 3> voxel{};
          for (std::size_t a = 0; a < 3; ++a)
          {
            const double place =
              mesh.points[corners[0]][a] + (u * (mesh.points[corners[1]][a] - mesh.points[corners[0]][a]) +
                                            v * (mesh.points[corners[2]][a] - mesh.points[corners[0]][a])) /
                                             steps;
            voxel[a] = std::clamp(static_cast<std::int32_t>(std::floor((place - grid.origin[a]) / grid.spacing[a])),
                                  0,
                                  grid.size[a] - 1);
          }
          EXPECT_TRUE(covered.shape.Contains(voxel[0], voxel[1], voxel[2]));
          near.insert(voxel);
        }
      }
    }
    const VoxelBox & box = covered.shape.Box();
    for (std::int32_t z = box.lower[2]; z < box.lower[2] + box.size[2]; ++z)
    {
      for (std::int32_t y = box.lower[1]; y < box.lower[1] + box.size[1]; ++y)
      {
        for (std::int32_t x = box.lower[0]; x < box.lower[0] + box.size[0]; ++x)
        {
          bool isNear = false;
          for (int n = 0; n < 27 && !isNear; ++n)
          {
            isNear = near.contains({ x + n % 3 - 1, y + n / 3 % 3 - 1, z + n / 9 - 1 });
          }
          EXPECT_TRUE(isNear || plain.shape.Contains(x, y, z) || !covered.shape.Contains(x, y, z));
        }
      }
    }
  }
}
