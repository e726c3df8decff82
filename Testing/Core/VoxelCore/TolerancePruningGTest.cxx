#include "voxelcore/VoxelCore/TolerancePruning.h"

#include "VoxelCoreTesting/Cores.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Complex/ComplexTopology.h"
#include "voxelcore/Shape/BoundaryVertices.h"
#include "voxelcore/VoxelCore/LambdaPruning.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>

namespace voxelcore
{
namespace
{

// All finite values, and heights between and beyond them.
std::vector<double>
Heights(const ToleranceValues & values, testing::Random & random)
{
  std::vector<double> heights{ 0 };
  for (int i = 0; i < 6 && !values.edges.empty(); ++i)
  {
    const auto   at = static_cast<std::size_t>(random.Between(0, static_cast<std::int64_t>(values.edges.size()) - 1));
    const double value = values.edges[at];
    heights.push_back(std::isfinite(value) ? value * (i % 2 == 0 ? 1.0 : 1.01) : 1e9);
  }
  return heights;
}

std::size_t
FreePairs(const CellComplex & cells)
{
  std::vector<int> facesAt(cells.edges.size(), 0);
  std::vector<int> edgesAt(cells.vertexCount, 0);
  for (const auto & ends : cells.edges)
  {
    ++edgesAt[ends[0]];
    ++edgesAt[ends[1]];
  }
  for (const ElementIndex edge : cells.faceEdges)
  {
    ++facesAt[edge];
  }
  return static_cast<std::size_t>(std::count(facesAt.begin(), facesAt.end(), 1) +
                                  std::count(edgesAt.begin(), edgesAt.end(), 1));
}

TEST(TolerancePruning, KeepsTheTopologyAtEveryHeight)
{
  for (const auto & volume : testing::RandomVolumes(1000, 100))
  {
    SCOPED_TRACE(volume.Describe());
    testing::Random       random(volume.seed);
    const MedialComplex   core = testing::CoreWithTolerancesOf(volume.shape, volume.spacing);
    const TopologyNumbers topology = ComputeComplexTopology(core.cells);
    for (const double height : Heights(core.tolerances, random))
    {
      ASSERT_EQ(ComputeComplexTopology(PruneByTolerance(core, height).cells), topology) << "at " << height;
    }
  }
}

// So what has a value above any height is a complex again, and a slider needs nothing but the values.
TEST(TolerancePruning, ValuesDoNotFallFromFacesToEdgesToVertices)
{
  for (const auto & volume : testing::RandomVolumes(1200, 60))
  {
    SCOPED_TRACE(volume.Describe());
    const MedialComplex     core = testing::CoreWithTolerancesOf(volume.shape, volume.spacing);
    const ToleranceValues & values = core.tolerances;
    ASSERT_EQ(values.vertices.size(), core.cells.vertexCount);
    ASSERT_EQ(values.edges.size(), core.cells.edges.size());
    ASSERT_EQ(values.faces.size(), core.cells.FaceCount());
    for (std::size_t edge = 0; edge < values.edges.size(); ++edge)
    {
      ASSERT_GE(values.edges[edge], 0.0);
      ASSERT_LE(values.edges[edge], values.vertices[core.cells.edges[edge][0]]);
      ASSERT_LE(values.edges[edge], values.vertices[core.cells.edges[edge][1]]);
    }
    for (std::size_t face = 0; face < values.faces.size(); ++face)
    {
      for (const ElementIndex edge : core.cells.FaceEdges(face))
      {
        ASSERT_LE(values.faces[face], values.edges[edge]);
      }
    }
  }
}

TEST(TolerancePruning, LeavesOnlyWhatTheTopologyNeedsInTheEnd)
{
  for (const auto & volume : testing::RandomVolumes(1300, 60))
  {
    SCOPED_TRACE(volume.Describe());
    const MedialComplex core = testing::CoreWithTolerancesOf(volume.shape, volume.spacing);
    const MedialComplex rest = PruneByTolerance(core, std::numeric_limits<double>::max());
    ASSERT_EQ(FreePairs(rest.cells), 0U);
    const TopologyNumbers numbers = ComputeComplexTopology(core.cells);
    if (numbers.betti[1] == 0 && numbers.betti[2] == 0)
    {
      ASSERT_EQ(rest.cells.vertexCount, static_cast<std::size_t>(numbers.betti[0]));
    }
  }
}

TEST(TolerancePruning, IsTheSameForBothEngines)
{
  if (!HasEngine(Engine::TetGen))
  {
    GTEST_SKIP() << "built without TetGen";
  }
  for (const auto & volume : testing::RandomVolumes(1400, 30))
  {
    SCOPED_TRACE(volume.Describe());
    const MedialComplex a = testing::CoreWithTolerancesOf(volume.shape, volume.spacing, Engine::Lattice);
    const MedialComplex b = testing::CoreWithTolerancesOf(volume.shape, volume.spacing, Engine::TetGen);
    ASSERT_EQ(a.tolerances.vertices, b.tolerances.vertices);
    ASSERT_EQ(a.tolerances.edges, b.tolerances.edges);
    ASSERT_EQ(a.tolerances.faces, b.tolerances.faces);
  }
}

TEST(TolerancePruning, TakesDegenerateShapes)
{
  const auto shell = testing::ShapeWhere({ 9, 9, 9 }, [](int x, int y, int z) {
    return x == 0 || y == 0 || z == 0 || x == 8 || y == 8 || z == 8;
  });
  const auto touching = testing::ShapeWhere({ 2, 2, 2 }, [](int x, int y, int z) { return x == y && y == z; });
  const std::vector<VoxelShape> shapes{
    VoxelShape(), testing::Box({ 1, 1, 1 }), testing::Box({ 1, 1, 17 }), testing::Box({ 12, 1, 9 }), touching, shell
  };
  for (std::size_t i = 0; i < shapes.size(); ++i)
  {
    SCOPED_TRACE("shape " + std::to_string(i));
    const MedialComplex   core = testing::CoreWithTolerancesOf(shapes[i]);
    const TopologyNumbers topology = ComputeComplexTopology(core.cells);
    for (const double height : { 0.0, 0.5, 1.0, 2.0, 100.0 })
    {
      ASSERT_EQ(ComputeComplexTopology(PruneByTolerance(core, height).cells), topology);
    }
  }
}

// A rod of one voxel is a path of balls all alike: from each end it shrinks by the height, but for the last step.
TEST(TolerancePruning, ShortensARodByTheHeightAtEachEnd)
{
  const MedialComplex core = testing::CoreWithTolerancesOf(testing::Box({ 1, 1, 40 }));
  for (const double height : { 1.5, 3.0, 6.0 })
  {
    const MedialComplex rest = PruneByTolerance(core, height);
    ASSERT_FALSE(rest.positions.empty());
    EXPECT_GE(rest.positions.front()[2], 0.5);
    EXPECT_LE(rest.positions.front()[2], 0.5 + height + 1.0);
    EXPECT_GE(rest.positions.back()[2], 39.5 - height - 1.0);
    EXPECT_EQ(rest.cells.vertexCount, rest.cells.edges.size() + 1);
    EXPECT_EQ(std::lround(rest.positions.back()[2] - rest.positions.front()[2]),
              static_cast<long>(rest.cells.edges.size()));
  }
}

// What one lambda cannot do: the thick part is cleared and the thin ones stay.
TEST(TolerancePruning, ClearsAThickPartAndKeepsThinOnesOnIt)
{
  const auto inRod = [](double x, double y, double z) { return y * y + z * z <= 1.6 * 1.6 && x >= 0 && x <= 30; };
  const auto inBall = [](double x, double y, double z) { return x * x + y * y + z * z <= 11 * 11; };
  // Off the lattice's symmetry, or all would be too tidy.
  const auto          shape = testing::ShapeWhere({ 46, 26, 26 }, [&](int i, int j, int k) {
    const double x = i + 0.5 - 12.3;
    const double y = j + 0.5 - 12.8;
    const double z = k + 0.5 - 13.1;
    return inRod(x, y, z) || inBall(x, y, z);
  });
  const MedialComplex core = testing::CoreWithTolerancesOf(shape);
  const MedialComplex rest = PruneByTolerance(core, 1.2 * std::sqrt(3.0));
  double              farthest = 0;
  double              outermost = 0;
  for (const auto & position : rest.positions)
  {
    const double x = position[0] - 12.3;
    const double y = position[1] - 12.8;
    const double z = position[2] - 13.1;
    farthest = std::max(farthest, std::sqrt(y * y + z * z + std::min(x, 0.0) * std::min(x, 0.0)));
    outermost = std::max(outermost, x);
  }
  EXPECT_LT(farthest, 2.0) << "spurs are left";
  EXPECT_GT(outermost, 30 - 1.6 - 2.6) << "the rod is lost";
}

TEST(TolerancePruning, DoesNotTearASheet)
{
  const MedialComplex core = testing::CoreWithTolerancesOf(testing::Box({ 30, 5, 24 }));
  const MedialComplex rest = PruneByTolerance(core, 1.5);
  double              area = 0;
  for (std::size_t face = 0; face < rest.cells.FaceCount(); ++face)
  {
    const auto corners = rest.cells.FaceVertices(face);
    for (std::size_t i = 0; i < corners.size(); ++i)
    {
      const auto & a = rest.positions[corners[i]];
      const auto & b = rest.positions[corners[i + 1 == corners.size() ? 0 : i + 1]];
      area += 0.5 * (a[0] * b[2] - a[2] * b[0]);
      EXPECT_EQ(a[1], 2.5);
    }
  }
  // Rims lie 2.5 from the sides and shrink by no more than the height; nothing is missing within.
  EXPECT_GE(std::abs(area), (25 - 3.0) * (19 - 3.0));
  EXPECT_EQ(rest.cells.vertexCount + rest.cells.FaceCount(), rest.cells.edges.size() + 1);
}

// What a floor takes goes whatever bump it stands for; of the rest nothing goes before its height.
TEST(TolerancePruning, BeginsWithWhatAFloorLeaves)
{
  for (const auto & volume : testing::RandomVolumes(1600, 40))
  {
    SCOPED_TRACE(volume.Describe());
    const double        floor = 1.2 * *std::min_element(volume.spacing.begin(), volume.spacing.end());
    const MedialComplex core = testing::CoreWithTolerancesOf(volume.shape, volume.spacing, Engine::Auto, floor);
    const MedialComplex least = PruneByTolerance(core, 0);
    MedialComplex       byLambda = PruneByLambda(core, { floor }).front();
    byLambda.tolerances = least.tolerances;
    testing::ExpectSameCore(least, byLambda);
    testing::Random random(volume.seed);
    for (const double height : Heights(core.tolerances, random))
    {
      ASSERT_EQ(ComputeComplexTopology(PruneByTolerance(core, height).cells), ComputeComplexTopology(core.cells));
    }
  }
}

TEST(TolerancePruning, LeavesAllAtHeightZero)
{
  for (const auto & volume : testing::RandomVolumes(1650, 20))
  {
    SCOPED_TRACE(volume.Describe());
    const MedialComplex core = testing::CoreWithTolerancesOf(volume.shape, volume.spacing);
    testing::ExpectSameCore(core, PruneByTolerance(core, 0));
  }
}

// So that rounding decides nothing where a round height is asked for.
TEST(TolerancePruning, GoesByLevelsBetweenRoundHeights)
{
  const MedialComplex core = testing::CoreWithTolerancesOf(testing::Ellipsoid(24));
  std::size_t         low = 0;
  for (const auto * values : { &core.tolerances.vertices, &core.tolerances.edges, &core.tolerances.faces })
  {
    for (const double value : *values)
    {
      const double steps = value / std::sqrt(3.0) * 80;
      if (steps < 320)
      {
        EXPECT_NEAR(steps - std::floor(steps), 0.5, 1e-9);
        ++low;
      }
    }
  }
  EXPECT_GT(low, 1000U);
}

TEST(TolerancePruning, CanBeCancelled)
{
  const VoxelShape     shape = testing::Ellipsoid(24);
  const SpacingWeights weights = ComputeSpacingWeights({ 1, 1, 1 });
  const auto           points = BoundaryVertices(shape);
  DelaunayCells        cells = ComputeDelaunayCells(shape, points, weights, Engine::Auto);
  auto                 touching = LargestTouchingBalls(shape, cells, points, weights);
  const MedialComplex  core = BuildVoxelCore(shape, points, std::move(cells), weights);
  EXPECT_THROW(
    ComputeTolerances(core, weights, points, std::move(touching), 0, [](std::string_view, double) { return false; }),
    Cancelled);
}

TEST(Tolerance, IsReadWithItsUnit)
{
  EXPECT_EQ(ToleranceInMillimetres(ParseTolerance("1.5"), { 3, 2, 6 }), 1.5);
  EXPECT_EQ(ToleranceInMillimetres(ParseTolerance(" 1.5 mm"), { 3, 2, 6 }), 1.5);
  EXPECT_EQ(ToleranceInMillimetres(ParseTolerance("1.5vox"), { 3, 2, 6 }), 3.0);
  EXPECT_EQ(ToleranceInMillimetres(ParseTolerance("2diag"), { 3, 2, 6 }), 14.0);
  EXPECT_EQ(ParseTolerance("2 diag").text, "2diag");
}

TEST(Tolerance, WithoutSenseIsRefused)
{
  for (const char * text : { "", "vox", "-1vox", "1 5vox", "nan", "inf", "1voxel", "1%", "1.5.2", "-0.1" })
  {
    EXPECT_THROW(ParseTolerance(text), UsageError) << text;
  }
}

} // namespace
} // namespace voxelcore
