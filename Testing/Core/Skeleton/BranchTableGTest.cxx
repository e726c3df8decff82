#include "GraphBuilder.h"

#include "voxelcore/Skeleton/BranchTable.h"

#include <algorithm>
#include <cmath>

namespace voxelcore::testing
{

namespace
{

TEST(BranchTable, SmallRootHasItsLevels)
{
  const SkeletonGraph graph = SmallRoot().Graph();
  for (const auto kind : { RootChoice::Kind::Thickest, RootChoice::Kind::Top, RootChoice::Kind::Point })
  {
    MeasureOptions options;
    options.root = { kind, { 1, 1, 70 } };
    const BranchTable table = MeasureBranches(graph, options);
    ASSERT_EQ(table.levels.size(), 3U);
    EXPECT_EQ(table.levels[0].count, 1);
    EXPECT_EQ(table.levels[1].count, 2);
    EXPECT_EQ(table.levels[2].count, 1);
    EXPECT_NEAR(table.levels[0].totalLength, 60, 1e-9);
    // Laterals begin at their parent's surface, that is at the first point that is not within the ball there.
    EXPECT_NEAR(table.levels[1].totalLength, 27 + 37, 1e-9);
    EXPECT_NEAR(table.levels[1].meanTipAngle, 90, 1e-6);
    EXPECT_EQ(table.axes[0].children, 2);
    EXPECT_EQ(table.numbers.tips, 5);
    EXPECT_EQ(table.numbers.junctions, 3);
    EXPECT_EQ(table.numbers.branches, 7);
    EXPECT_EQ(table.numbers.components, 1);
    EXPECT_EQ(table.numbers.cycles, 0);
    std::int32_t strahler = 0;
    for (const BranchRecord & branch : table.branches)
    {
      strahler = std::max(strahler, branch.strahler);
    }
    EXPECT_EQ(strahler, 2);
  }
}

TEST(BranchTable, TheRootMayLieAtTheBottom)
{
  const SkeletonGraph graph = SmallRoot().Graph();
  MeasureOptions      options;
  options.root.kind = RootChoice::Kind::Bottom;
  const BranchTable table = MeasureBranches(graph, options);
  ASSERT_FALSE(table.axes.empty());
  const ElementIndex first = table.axes[0].branches[0];
  const auto         points = graph.Branch(first);
  EXPECT_EQ(graph.positions[table.branches[first].baseIsLast ? points.back() : points.front()], (Spacing3{ 0, 0, 0 }));
}

TEST(BranchTable, NumbersOfAStraightBranch)
{
  GraphBuilder builder;
  builder.Line({ 0, 0, 0 }, { 30, 40, 0 }, 2);
  const BranchTable    table = MeasureBranches(builder.Graph());
  const BranchRecord & branch = table.branches.at(0);
  EXPECT_NEAR(branch.length, 50, 1e-9);
  EXPECT_NEAR(branch.chord, 50, 1e-9);
  EXPECT_NEAR(branch.tortuosity, 1, 1e-12);
  EXPECT_NEAR(branch.meanRadius, 2, 1e-12);
  EXPECT_NEAR(branch.sdRadius, 0, 1e-6);
  EXPECT_NEAR(branch.volume, 3.14159265358979 * 4 * 50, 1e-6);
  EXPECT_NEAR(branch.surface, 3.14159265358979 * 4 * 50, 1e-6);
  EXPECT_EQ(branch.type, BranchType::TipToTip);
}

TEST(BranchTable, WhatIsOutsideTheBallsAtBothEndsIsFree)
{
  GraphBuilder builder;
  builder.Line({ 0, 0, 0 }, { 20, 0, 0 }, 3);
  for (const double x : { 0.0, 20.0 })
  {
    builder.Line({ x, 0, 0 }, { x, 12, 0 }, 1);
    builder.Line({ x, 0, 0 }, { x, -12, 0 }, 1);
  }
  const BranchTable table = MeasureBranches(builder.Graph());
  const auto        middle = std::find_if(table.branches.begin(), table.branches.end(), [](const auto & branch) {
    return branch.type == BranchType::JunctionToJunction;
  });
  ASSERT_NE(middle, table.branches.end());
  EXPECT_NEAR(middle->length, 20, 1e-12);
  EXPECT_LE(middle->freeLength, 20 - 2 * 3 + 1e-12);
  EXPECT_GE(middle->freeLength, 20 - 2 * 4 - 1e-12); // points are 1 mm apart
}

TEST(BranchTable, WhereNothingIsFreeTheMeanRadiusIsByLength)
{
  GraphBuilder builder;
  for (const double x : { -2.0, 2.0 })
  {
    builder.Line({ 0, 0, 0 }, { x, 0, 0 }, 5);
    builder.Line({ 0, 0, 0 }, { 0, x, 0 }, 5);
  }
  const BranchTable table = MeasureBranches(builder.Graph());
  ASSERT_EQ(table.branches.size(), 4U);
  EXPECT_EQ(table.branches[0].freeLength, 0);
  EXPECT_NEAR(table.numbers.meanRadius, 5, 1e-12);
}

TEST(BranchTable, TheDirectionOfABranchWithinABallLeadsToItsTip)
{
  GraphBuilder builder;
  builder.Line({ 0, 0, 60 }, { 0, 0, 30 }, 3);
  builder.Line({ 0, 0, 30 }, { 0, 0, 0 }, 3);
  builder.Line({ 0, 0, 30 }, { 1, 0, 30 }, 1);
  builder.Line({ 1, 0, 30 }, { 1, 0, 28 }, 1);
  MeasureOptions options;
  options.root.kind = RootChoice::Kind::Top;
  const BranchTable table = MeasureBranches(builder.Graph(), options);
  const auto        stub =
    std::find_if(table.branches.begin(), table.branches.end(), [](const auto & branch) { return branch.length < 10; });
  ASSERT_NE(stub, table.branches.end());
  EXPECT_NEAR(stub->parentAngle, std::atan2(1.0, 2.0) * 180 / M_PI, 1e-6);
}

TEST(BranchTable, CyclesAreCutAtTheirThinnestBranch)
{
  GraphBuilder builder;
  builder.Line({ -10, 0, 0 }, { 0, 0, 0 }, 3);
  builder.Line({ 0, 0, 0 }, { 10, 10, 0 }, 3);
  builder.Line({ 0, 0, 0 }, { 10, -10, 0 }, 1);
  builder.Line({ 10, 10, 0 }, { 20, 0, 0 }, 3);
  builder.Line({ 10, -10, 0 }, { 20, 0, 0 }, 1);
  builder.Line({ 20, 0, 0 }, { 30, 0, 0 }, 3);
  SkeletonGraph     graph = builder.Graph();
  const BranchTable table = MeasureBranches(graph);
  EXPECT_EQ(table.numbers.cycles, 1);
  EXPECT_EQ(table.numbers.branches, 4);
  double length = 0;
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    length += graph.BranchLength(branch);
    EXPECT_EQ(table.branches[branch].closesLoop, table.branches[branch].minRadius == 1);
  }
  const auto cuts = CutLoops(graph);
  ASSERT_EQ(cuts.size(), 1U);
  EXPECT_EQ(cuts[0].radius, 1);
  const BranchTable cut = MeasureBranches(graph);
  EXPECT_EQ(cut.numbers.cycles, 0);
  EXPECT_EQ(cut.numbers.components, 1);
  EXPECT_EQ(cut.numbers.tips, 4);
  EXPECT_NEAR(cut.numbers.totalLength, length, 1e-9);
}

TEST(BranchTable, RingIsOneIsolatedLoop)
{
  GraphBuilder builder;
  builder.Line({ 0, 0, 0 }, { 10, 0, 0 }, 1);
  builder.Line({ 10, 0, 0 }, { 10, 10, 0 }, 1);
  builder.Line({ 10, 10, 0 }, { 0, 0, 0 }, 1);
  SkeletonGraph graph = builder.Graph();
  BranchTable   table = MeasureBranches(graph);
  EXPECT_EQ(table.numbers.isolatedLoops, 1);
  EXPECT_EQ(table.numbers.cycles, 1);
  EXPECT_EQ(table.branches.at(0).type, BranchType::Cycle);
  EXPECT_EQ(CutLoops(graph).size(), 1U);
  table = MeasureBranches(graph);
  EXPECT_EQ(table.numbers.cycles, 0);
  EXPECT_EQ(table.numbers.tips, 2);
  EXPECT_NEAR(table.numbers.totalLength, 20 + std::sqrt(200), 1e-9);
}

TEST(BranchTable, ComponentsAndCyclesAreTheShapes)
{
  for (std::uint64_t seed = 1; seed <= 40; ++seed)
  {
    const RandomVolume    volume = MakeRandomVolume(seed, 3, 9);
    const MedialComplex   surface = SurfaceOf(volume.shape, volume.spacing);
    const TopologyNumbers expected = ComputeComplexTopology(surface.cells);
    if (expected.betti[2] > 0)
    {
      continue;
    }
    SkeletonGraph graph = BuildSkeletonGraph(SkeletonOf(surface, 1));
    for (const bool pruned : { false, true })
    {
      if (pruned)
      {
        PruneBranches(graph, { 3, 1 });
      }
      const SkeletonNumbers numbers = MeasureBranches(graph).numbers;
      ASSERT_EQ(numbers.components, expected.betti[0]) << volume.Describe();
      ASSERT_EQ(numbers.cycles, expected.betti[1]) << volume.Describe();
    }
    ASSERT_EQ(static_cast<std::int64_t>(CutLoops(graph).size()), expected.betti[1]) << volume.Describe();
    ASSERT_EQ(MeasureBranches(graph).numbers.cycles, 0) << volume.Describe();
  }
}

} // namespace

} // namespace voxelcore::testing
