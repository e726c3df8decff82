// What is computed of a body does not depend on where in the grid it lies, nor on how much there is around it.

#include "CertifiedFixtures.h"

#include "voxelcore/Certified/CertifiedThickness.h"
#include "voxelcore/Shape/BodyFrame.h"

#include "VoxelCoreTesting/Random.h"
#include "VoxelCoreTesting/Shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace voxelcore
{
namespace
{

using Lower = std::array<std::int32_t, 3>;

/** Three capsules that hang together, noisy by a tenth of their boundary voxels, and what is empty around them. */
VoxelShape
RandomBody(testing::Random & random, const Lower & lower, const std::array<std::int32_t, 3> & margin)
{
  constexpr std::int32_t side = 20;
  std::array<Vector3, 4> ends{};
  for (Vector3 & end : ends)
  {
    for (double & x : end)
    {
      x = 5 + 10 * random.Unit();
    }
  }
  std::array<double, 3> radii{};
  for (double & radius : radii)
  {
    radius = 1.5 + 2.5 * random.Unit();
  }
  VoxelBox box{ lower, {} };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    box.lower[axis] -= margin[axis];
    box.size[axis] = side + 2 * margin[axis];
  }
  VoxelShape shape(box);
  for (std::int32_t z = 0; z < side; ++z)
  {
    for (std::int32_t y = 0; y < side; ++y)
    {
      for (std::int32_t x = 0; x < side; ++x)
      {
        double depth = -1;
        for (std::size_t k = 0; k < 3; ++k)
        {
          Vector3 way{};
          Vector3 from{ x + 0.5, y + 0.5, z + 0.5 };
          double  along = 0;
          double  length = 0;
          for (std::size_t axis = 0; axis < 3; ++axis)
          {
            way[axis] = ends[k + 1][axis] - ends[k][axis];
            from[axis] -= ends[k][axis];
            along += way[axis] * from[axis];
            length += way[axis] * way[axis];
          }
          const double t = std::clamp(along / std::max(length, 1e-9), 0.0, 1.0);
          depth =
            std::max(depth, radii[k] - std::hypot(from[0] - t * way[0], from[1] - t * way[1], from[2] - t * way[2]));
        }
        if (depth > (random.Chance(0.1) ? 0.4 : 0.0))
        {
          shape.Insert(lower[0] + x, lower[1] + y, lower[2] + z);
        }
      }
    }
  }
  return shape;
}

struct Placing
{
  Lower                       lower{};
  std::array<std::int32_t, 3> margin{};
  std::int64_t                room = 0; ///< voxels of the scan beyond the body's box
};

struct Computed
{
  CertifiedResult   result;
  CertifiedSkeleton later; ///< of the core as it stands in a file
  MedialSheets      sheets;
};

Computed
Compute(std::uint64_t seed, const Placing & placing, ImageGeometry geometry)
{
  testing::Random  random(seed);
  const VoxelShape shape = RandomBody(random, placing.lower, placing.margin);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    geometry.size[axis] = placing.lower[axis] + 20 + placing.room;
  }
  CertifiedRequest request;
  request.skeleton = SkeletonRequest{};
  request.skeleton->lambda = ParseLambda("0");
  request.skeleton->standOut = ParseLambda("3vox");
  request.skeleton->smooth = ParseLambda("4vox");
  request.thickness = ThicknessRequest{};
  Computed computed{ ComputeCertified(shape, geometry, request), {}, {} };
  computed.later = SkeletonOf(computed.result.cores[0].core, computed.result.shape, *request.skeleton);
  computed.sheets = SheetsOf(computed.result.cores[0].core, computed.result.shape, 3);
  return computed;
}

/** Lattice coordinates from the body's box on. */
std::vector<Vector3>
Places(const CertifiedShape & shape, const std::vector<Vector3> & positions)
{
  std::vector<Vector3> places = positions;
  for (Vector3 & place : places)
  {
    place = OnPlaces(PhysicalToLattice(shape.geometry, place));
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      place[axis] -= shape.box.lower[axis];
    }
  }
  return places;
}

void
ExpectSame(const Computed & one, const Computed & other)
{
  const auto & here = one.result;
  const auto & there = other.result;
  ASSERT_EQ(here.shape.box.size, there.shape.box.size);
  const MedialComplex & a = here.cores[0].core.core;
  const MedialComplex & b = there.cores[0].core.core;
  EXPECT_EQ(Places(here.shape, a.positions), Places(there.shape, b.positions));
  EXPECT_EQ(a.radius, b.radius);
  EXPECT_EQ(a.cells.edges, b.cells.edges);
  EXPECT_EQ(a.cells.faceVertices, b.cells.faceVertices);
  EXPECT_EQ(a.tolerances.vertices, b.tolerances.vertices);
  EXPECT_EQ(here.cores[0].numbers.complex.areaMm2, there.cores[0].numbers.complex.areaMm2);
  EXPECT_EQ(here.whole.areaMm2, there.whole.areaMm2);
  EXPECT_EQ(here.cores[0].core.displacement, there.cores[0].core.displacement);
  EXPECT_EQ(here.thickness->map.values, there.thickness->map.values);
  EXPECT_EQ(here.thickness->owners.values, there.thickness->owners.values);
  EXPECT_EQ(here.thickness->atVertices, there.thickness->atVertices);
  for (const auto & [p, q] : { std::pair(&*here.skeleton, &*there.skeleton), std::pair(&one.later, &other.later) })
  {
    const SkeletonGraph & g = p->skeleton.graph;
    const SkeletonGraph & h = q->skeleton.graph;
    EXPECT_EQ(Places(here.shape, g.positions), Places(there.shape, h.positions));
    EXPECT_EQ(g.radius, h.radius);
    EXPECT_EQ(g.sectionRadius, h.sectionRadius);
    EXPECT_EQ(g.branchPoints, h.branchPoints);
    EXPECT_NEAR(p->skeleton.table.numbers.totalLength, q->skeleton.table.numbers.totalLength, 1e-9);
  }
  EXPECT_EQ(one.sheets.sheetOfFace, other.sheets.sheetOfFace);
  EXPECT_EQ(one.sheets.pieceOfVertex, other.sheets.pieceOfVertex);
  ASSERT_EQ(one.sheets.sheets.size(), other.sheets.sheets.size());
  for (std::size_t i = 0; i < one.sheets.sheets.size(); ++i)
  {
    EXPECT_EQ(one.sheets.sheets[i].area, other.sheets.sheets[i].area);
  }
}

/** A body close in a corner of its scan, against the same one far out in a great one, and with empty voxels in its box
 *  that are no one's. */
void
ExpectSameEverywhere(std::uint64_t seed)
{
  SCOPED_TRACE("seed " + std::to_string(seed));
  testing::Random random(seed + 1000);
  ImageGeometry   geometry;
  geometry.spacing = random.Chance(0.5) ? Vector3{ 1, 1, 1 } : Vector3{ 0.7, 0.7, 1.3 };
  const double turn = random.Unit();
  geometry.direction = { std::cos(turn), -std::sin(turn), 0, std::sin(turn), std::cos(turn), 0, 0, 0, 1 };
  geometry.origin = { 100 * random.Unit() - 50, 0.1, -731.25 };
  const auto any = [&](std::int64_t least, std::int64_t most) {
    Lower lower{};
    for (std::int32_t & x : lower)
    {
      x = static_cast<std::int32_t>(random.Between(least, most));
    }
    return lower;
  };
  const Computed corner = Compute(seed, { { 0, 0, 0 }, { 0, 0, 0 }, 0 }, geometry);
  ExpectSame(corner, Compute(seed, { any(1, 70), { 0, 0, 0 }, 13 }, geometry));
  ExpectSame(corner, Compute(seed, { any(100, 400), any(0, 9), 50 }, geometry));
}

TEST(PlaceInGrid, MakesNoDifferenceToRefinedRims)
{
  const VoxelShape   shape = testing::Ellipsoid(40);
  constexpr Lower    by{ 61, 5, 203 };
  VoxelShape         moved(VoxelBox{ by, { 40, 40, 40 } });
  const std::int32_t side = 40;
  for (std::int32_t z = 0; z < side; ++z)
  {
    for (std::int32_t y = 0; y < side; ++y)
    {
      for (std::int32_t x = 0; x < side; ++x)
      {
        if (shape.Contains(x, y, z))
        {
          moved.Insert(by[0] + x, by[1] + y, by[2] + z);
        }
      }
    }
  }
  CertifiedRequest request;
  request.tolerances = { ParseTolerance("1.2diag") };
  ImageGeometry grid = Grid({ 1, 1, 1 });
  grid.size = { 300, 300, 300 };
  const CertifiedResult here = ComputeCertified(shape, grid, request);
  const CertifiedResult there = ComputeCertified(moved, grid, request);
  const MedialComplex & a = here.cores[0].core.core;
  const MedialComplex & b = there.cores[0].core.core;
  EXPECT_GT(a.cells.FaceCount(), 100U);
  EXPECT_EQ(Places(here.shape, a.positions), Places(there.shape, b.positions));
  EXPECT_EQ(here.cores[0].core.displacement, there.cores[0].core.displacement);
  EXPECT_EQ(a.radius, b.radius);
  EXPECT_EQ(a.cells.edges, b.cells.edges);
  EXPECT_EQ(a.cells.faceVertices, b.cells.faceVertices);
  EXPECT_EQ(a.tolerances.faces, b.tolerances.faces);
}

TEST(PlaceInGrid, MakesNoDifferenceToCoresSkeletonsSheetsAndThickness)
{
  for (std::uint64_t seed = 61'000; seed < 61'003; ++seed)
  {
    ExpectSameEverywhere(seed);
  }
}

} // namespace
} // namespace voxelcore
