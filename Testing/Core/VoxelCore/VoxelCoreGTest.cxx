// Cores a person can check by hand, and those other programs have computed.

#include "VoxelCoreTesting/Cores.h"

#include "voxelcore/Complex/ComplexTopology.h"
#include "voxelcore/Shape/BoundaryVertices.h"
#include "voxelcore/VoxelCore/LambdaPruning.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace voxelcore
{
namespace
{

using testing::Box;
using testing::CoreOf;
using testing::ShapeWhere;
using testing::Size3;
using testing::Spacing3;
using testing::TestSpacings;

double
Norm(double x, double y, double z = 0)
{
  return std::sqrt(x * x + y * y + z * z);
}

void
ExpectCounts(const MedialComplex & core, std::size_t vertices, std::size_t edges, std::size_t faces)
{
  EXPECT_EQ(core.cells.vertexCount, vertices);
  EXPECT_EQ(core.cells.edges.size(), edges);
  EXPECT_EQ(core.cells.FaceCount(), faces);
}

TEST(KnownCores, NothingHasNone)
{
  ExpectCounts(CoreOf(VoxelShape(VoxelBox{ { 0, 0, 0 }, { 5, 5, 5 } })), 0, 0, 0);
  ExpectCounts(CoreOf(VoxelShape()), 0, 0, 0);
}

TEST(KnownCores, AVoxelHasItsCentre)
{
  const MedialComplex core = CoreOf(Box({ 1, 1, 1 }, { 2, 3, 4 }));
  ExpectCounts(core, 1, 0, 0);
  EXPECT_EQ(core.positions[0], (std::array<double, 3>{ 2.5, 3.5, 4.5 }));
  EXPECT_EQ(core.radius[0], std::sqrt(0.75));
  EXPECT_EQ(core.vertexLambda[0], std::sqrt(0.75));
  for (const Spacing3 & spacing : TestSpacings())
  {
    const MedialComplex scaled = CoreOf(Box({ 1, 1, 1 }), spacing);
    ExpectCounts(scaled, 1, 0, 0);
    EXPECT_NEAR(scaled.radius[0], 0.5 * Norm(spacing[0], spacing[1], spacing[2]), 1e-14);
  }
}

TEST(KnownCores, ARodHasOneVertexAVoxelAndTheEdgesBetween)
{
  for (const Spacing3 & spacing : TestSpacings())
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      Size3 size{ 1, 1, 1 };
      size[axis] = 9;
      const MedialComplex core = CoreOf(Box(size), spacing);
      ExpectCounts(core, 9, 8, 0);
      for (std::uint32_t i = 0; i < 8; ++i)
      {
        EXPECT_EQ(core.positions[i][axis], i + 0.5);
        EXPECT_EQ(core.cells.edges[i], (std::array<ElementIndex, 2>{ i, i + 1 }));
        EXPECT_NEAR(core.edgeLambda[i], 0.5 * Norm(spacing[(axis + 1) % 3], spacing[(axis + 2) % 3]), 1e-14);
      }
    }
  }
}

TEST(KnownCores, APlateIsAGridOfSquares)
{
  for (const Spacing3 & spacing : TestSpacings())
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      Size3 size{ 4, 4, 4 };
      size[axis] = 1;
      size[(axis + 1) % 3] = 6;
      const MedialComplex core = CoreOf(Box(size), spacing);
      ExpectCounts(core, 24, 4 * 5 + 6 * 3, 5 * 3);
      for (std::size_t face = 0; face < core.cells.FaceCount(); ++face)
      {
        EXPECT_EQ(core.cells.FaceVertices(face).size(), 4U);
        EXPECT_NEAR(core.faceLambda[face], 0.5 * spacing[axis], 1e-14);
      }
    }
  }
}

TEST(KnownCores, VoxelsThatTouchAlongAnEdgeOrACornerAreApart)
{
  const MedialComplex edge = CoreOf(ShapeWhere({ 2, 2, 1 }, [](int x, int y, int) { return x == y; }));
  ExpectCounts(edge, 2, 0, 0);
  EXPECT_EQ(ComputeComplexTopology(edge.cells).betti[0], 2);
  const MedialComplex corner = CoreOf(ShapeWhere({ 2, 2, 2 }, [](int x, int y, int z) { return x == y && y == z; }));
  ExpectCounts(corner, 2, 0, 0);
}

TEST(KnownCores, AShellHasACavityAndKeepsItAtAnyLambda)
{
  const VoxelShape      shell = ShapeWhere({ 7, 7, 7 }, [](int x, int y, int z) {
    return std::max({ std::abs(x - 3), std::abs(y - 3), std::abs(z - 3) }) >= 1;
  });
  const MedialComplex   core = CoreOf(shell);
  const TopologyNumbers expected{ 2, { 1, 0, 1 } };
  EXPECT_EQ(ComputeComplexTopology(core.cells), expected);
  const auto pruned = PruneByLambda(core, { 0, 1, 1000 });
  for (const MedialComplex & part : pruned)
  {
    EXPECT_EQ(ComputeComplexTopology(part.cells), expected);
    EXPECT_GT(part.cells.FaceCount(), 0U);
  }
}

TEST(KnownCores, ARingPrunesToItsLoopAndABlockToAPoint)
{
  const VoxelShape ring = ShapeWhere({ 5, 5, 1 }, [](int x, int y, int) { return x % 4 == 0 || y % 4 == 0; });
  const auto       loop = PruneByLambda(CoreOf(ring), { 1000 }).front();
  ExpectCounts(loop, 16, 16, 0);
  const auto point = PruneByLambda(CoreOf(Box({ 5, 4, 3 })), { 1000 }).front();
  ExpectCounts(point, 1, 0, 0);
}

// How many faces lie half way between the two sides of a slab three voxels thick, by hand: one over each lattice point
// whose Delaunay edge through the slab exists. d steps of s from the rim, whose nearest points lie half a voxel off the
// middle, the ball's centre can give way inwards by less than s / 2: (d s + s / 2)^2 + (1/2)^2 > (s / 2)^2 + (3/2)^2.
std::size_t
MiddleFaces(std::int32_t side, double thin, double first, double second)
{
  const auto count = [&](double spacing) {
    std::size_t inner = 0;
    for (std::int32_t i = 1; i < side; ++i)
    {
      const int d = std::min(i, side - i);
      inner += d * (d + 1) * (spacing * spacing) > 2 * (thin * thin) * (1 + 1e-9);
    }
    return inner;
  };
  return count(first) * count(second);
}

TEST(KnownCores, ASlabThreeVoxelsThickSurvivesOneAndAHalfVoxels)
{
  const std::vector<Spacing3> spacings{ { 1, 1, 1 },    { 0.7, 0.7, 0.7 }, { 0.1, 0.1, 0.1 },
                                        { 1, 1, 2 },    { 3, 3, 7 },       { 0.48828125, 0.48828125, 2.5 },
                                        { 2, 1, 3 },    { 0.3, 0.9, 0.6 }, { 0.9765625, 0.9765625, 3.0 },
                                        { 1, 1.37, 2 }, { 0.33, 0.33, 1 }, { 1.0 / 3.0, 1.0 / 3.0, 1.0 / 7.0 } };
  for (const Spacing3 & spacing : spacings)
  {
    const SpacingWeights weights = ComputeSpacingWeights(spacing);
    const double         smallest = std::min({ spacing[0], spacing[1], spacing[2] });
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      SCOPED_TRACE(::testing::Message() << "spacing " << spacing[0] << " : " << spacing[1] << " : " << spacing[2]
                                        << ", slab across axis " << axis);
      const std::int32_t side = 12;
      Size3              size{ side, side, side };
      size[axis] = 3;
      const VoxelShape    slab = Box(size);
      const MedialComplex core = CoreOf(slab, spacing);
      const double        lambda = LambdaInMillimetres(ParseLambda("1.5vox"), weights, spacing, slab.Box());
      const auto          pruned = PruneByLambda(core, { lambda }).front();
      const auto          kept =
        std::count_if(pruned.faceLambda.begin(), pruned.faceLambda.end(), [&](double m) { return m >= lambda; });
      const std::size_t middle = MiddleFaces(side, spacing[axis], spacing[(axis + 1) % 3], spacing[(axis + 2) % 3]);
      EXPECT_GE(static_cast<std::size_t>(kept), middle);
      if (spacing[axis] == smallest)
      {
        ASSERT_GT(middle, 0U);
        // The tie itself: threshold and measure are the same double.
        EXPECT_EQ(static_cast<std::size_t>(std::count(pruned.faceLambda.begin(), pruned.faceLambda.end(), lambda)),
                  middle);
      }
    }
  }
}

TEST(KnownCores, ASlabLosesItsFacesOnceTheEdgesBetweenThemGo)
{
  // Cubes: faces measure 1.5; the edges between them belong to rectangles of 1 x 3, sqrt(10) / 2 = 1.58114.
  const VoxelShape    slab = Box({ 12, 12, 3 });
  const MedialComplex core = CoreOf(slab);
  const auto          pruned = PruneByLambda(core, { 1.5, 1.58, 1.59, 1.7 });
  EXPECT_EQ(pruned[0].cells.FaceCount(), 81U);
  EXPECT_GE(pruned[1].cells.FaceCount(), 49U);
  EXPECT_EQ(pruned[2].cells.FaceCount(), 0U);
  // The vertices, sqrt(11) / 2 = 1.658, keep a tree up to their own measure.
  EXPECT_GT(pruned[2].cells.edges.size(), 60U);
  ExpectCounts(pruned[3], 1, 0, 0);
}

double
Area(const MedialComplex & core)
{
  double area = 0;
  for (std::size_t face = 0; face < core.cells.FaceCount(); ++face)
  {
    const auto polygon = core.cells.FaceVertices(face);
    double     normal[3]{ 0, 0, 0 };
    const auto from = [&](std::size_t i, std::size_t axis) {
      return core.positions[polygon[i]][axis] - core.positions[polygon[0]][axis];
    };
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        normal[axis] +=
          from(i, (axis + 1) % 3) * from(i + 1, (axis + 2) % 3) - from(i, (axis + 2) % 3) * from(i + 1, (axis + 1) % 3);
      }
    }
    area += 0.5 * Norm(normal[0], normal[1], normal[2]);
  }
  return area;
}

TEST(KnownCores, TheEllipsoidOf64IsWhatTwoOtherProgramsFound)
{
  const VoxelShape shape = testing::Ellipsoid(64);
  EXPECT_EQ(CountBoundaryVertices(shape), 7354U);
  const MedialComplex core = CoreOf(shape);
  ExpectCounts(core, 7474, 16427, 8954);
  EXPECT_NEAR(Area(core), 27153.226, 0.0005);
  EXPECT_EQ(ComputeComplexTopology(core.cells), (TopologyNumbers{ 1, { 1, 0, 0 } }));
}

TEST(KnownCores, TheEllipsoidOf128IsWhatTwoOtherProgramsFound)
{
  ExpectCounts(CoreOf(testing::Ellipsoid(128)), 31618, 69247, 37630);
}

TEST(KnownCores, TheEllipsoidOf256IsWhatTwoOtherProgramsFound)
{
  const VoxelShape shape = testing::Ellipsoid(256);
  EXPECT_EQ(CountBoundaryVertices(shape), 117410U);
  ExpectCounts(CoreOf(shape), 132902, 288454, 155553);
}

} // namespace
} // namespace voxelcore
