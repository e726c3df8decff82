#include "RootTurning.h"

#include "GraphBuilder.h"

#include <gtest/gtest.h>

#include <cmath>

namespace voxelcore::testing
{
namespace
{

/** The branch between two nodes. */
ElementIndex
BranchOf(const SkeletonGraph & graph, const Spacing3 & a, const Spacing3 & b)
{
  for (ElementIndex branch = 0; branch < graph.BranchCount(); ++branch)
  {
    const Spacing3 & first = graph.positions[graph.Branch(branch).front()];
    const Spacing3 & last = graph.positions[graph.Branch(branch).back()];
    if ((first == a && last == b) || (first == b && last == a))
    {
      return branch;
    }
  }
  ADD_FAILURE() << "no branch leads there";
  return 0;
}

/** Whether a branch is run through from `base` on. */
bool
LeadsFrom(const SkeletonGraph & graph, const RootFlow & flow, ElementIndex branch, const Spacing3 & base)
{
  const auto points = graph.Branch(branch);
  return graph.positions[flow.base[branch] ? points.back() : points.front()] == base;
}

BranchEnd
StemOf(const SkeletonGraph & graph)
{
  const RootBranches branches(graph);
  return FindStems(branches, Vector3{ 0, 0, 1 }, 1).front();
}

/** The root that ends at a tip. */
const RootAxis &
AxisTo(const SkeletonGraph & graph, const RootHierarchy & roots, const Spacing3 & tip)
{
  for (const RootAxis & axis : roots.axes)
  {
    if (graph.positions[axis.points.back()] == tip)
    {
      return axis;
    }
  }
  ADD_FAILURE() << "no root ends there";
  return roots.axes.front();
}

RootHierarchy
RootsOf(const SkeletonGraph & graph)
{
  RootRules rules;
  rules.up = Vector3{ 0, 0, 1 };
  return FindRoots(graph, rules);
}

constexpr Spacing3 kTouch{ 40, 0, 60 };

/** A stem with a lateral, and a lower one whose own lateral goes through the first beyond many turns of its parent. */
SkeletonGraph
LateralOfALateralThatTouches()
{
  GraphBuilder builder;
  builder.Line({ 0, 0, 120 }, { 0, 0, 100 }, 4);
  builder.Line({ 0, 0, 100 }, { 0, 0, 30 }, 4);
  builder.Line({ 0, 0, 30 }, { 0, 0, 0 }, 4);
  builder.Line({ 0, 0, 100 }, kTouch, 1);
  builder.Line(kTouch, { 80, 0, 20 }, 1);
  builder.Line({ 0, 0, 30 }, { 20, 30, 10 }, 1); // a bend with a twig
  builder.Line({ 20, 30, 10 }, { 0, 30, 30 }, 1);
  builder.Line({ 20, 30, 10 }, { 40, 10, 20 }, 1);
  builder.Line({ 40, 10, 20 }, { 70, -20, 35 }, 1);
  builder.Line({ 40, 10, 20 }, kTouch, 1);
  builder.Line(kTouch, { 40, -10, 100 }, 1);
  return builder.Graph();
}

TEST(RootTurning, ARootThatWasReachedFromAContactIsTurned)
{
  const SkeletonGraph graph = LateralOfALateralThatTouches();
  const RootBranches  branches(graph);
  const RootRules     rules;
  RootFlow            flow = FlowFrom(branches, { StemOf(graph) });
  const ElementIndex  back = BranchOf(graph, { 40, 10, 20 }, kTouch);
  ASSERT_TRUE(LeadsFrom(graph, flow, back, kTouch)) << "the phantom is no longer what it is meant to be";
  const RootPairing pairing = PairBranches(branches, flow, rules, false);
  EXPECT_EQ(TurnBackRoots(branches, rules, pairing, flow), 1U);
  EXPECT_TRUE(LeadsFrom(graph, flow, back, { 40, 10, 20 }));
  EXPECT_TRUE(LeadsFrom(graph, flow, BranchOf(graph, kTouch, { 40, -10, 100 }), kTouch));
  EXPECT_EQ(TurnBackRoots(branches, rules, PairBranches(branches, flow, rules, false), flow), 0U);
}

TEST(RootTurning, ALateralThatTouchesAnotherSpringsWhereItMeetsItsParent)
{
  const SkeletonGraph graph = LateralOfALateralThatTouches();
  const RootHierarchy roots = RootsOf(graph);
  EXPECT_EQ(roots.axes.size(), 5U);
  const RootAxis & lateral = AxisTo(graph, roots, { 40, -10, 100 });
  EXPECT_EQ(graph.positions[lateral.points.front()], (Spacing3{ 40, 10, 20 }));
  EXPECT_EQ(lateral.level, 2);
  EXPECT_EQ(AxisTo(graph, roots, { 80, 0, 20 }).level, 1);
  EXPECT_EQ(roots.meetings.size(), 1U);
}

// However crooked a stem is, a lateral that springs from it is not reached from another lateral before.
TEST(RootTurning, LateralsCostTheSameAllAlongACrookedStem)
{
  GraphBuilder builder;
  const auto   at = [](int k) { return Spacing3{ k % 2 == 0 ? 0.0 : -6.0, 0, 130.0 - 10 * k }; };
  builder.Line({ 0, 0, 150 }, at(0), 3);
  for (int k = 0; k < 7; ++k)
  {
    builder.Line(at(k), at(k + 1), 3);
    if (k > 0 && k < 6)
    {
      builder.Line(at(k), { at(k)[0] - 20, 0, at(k)[2] }, 0.5);
    }
  }
  builder.Line(at(0), kTouch, 1);
  builder.Line(at(6), kTouch, 1);
  builder.Line(kTouch, { 65, 0, 16 }, 1);
  builder.Line(kTouch, { 80, 0, 50 }, 1);
  const SkeletonGraph graph = builder.Graph();
  const RootFlow      flow = FlowFrom(RootBranches(graph), { StemOf(graph) });
  EXPECT_TRUE(LeadsFrom(graph, flow, BranchOf(graph, at(0), kTouch), at(0)));
  EXPECT_TRUE(LeadsFrom(graph, flow, BranchOf(graph, at(6), kTouch), at(6)));
}

// Two roots share a stretch that one runs through outwards and the other inwards.
TEST(RootTurning, ARootGoesOnFromTheOtherEndOfAStretchThatItSharesBackwards)
{
  GraphBuilder builder;
  builder.Line({ 0, 0, 120 }, { 0, 0, 90 }, 4);
  builder.Line({ 0, 0, 90 }, { 0, 0, 20 }, 4);
  builder.Line({ 0, 0, 20 }, { 0, 0, 0 }, 4);
  builder.Line({ 0, 0, 90 }, { 40, 0, 90 }, 1);
  builder.Line({ 40, 0, 90 }, { 46, 0, 90 }, 1);
  builder.Line({ 46, 0, 90 }, { 90, 0, 90 }, 1);
  builder.Line({ 0, 0, 20 }, { 80, 30, 60 }, 1);
  builder.Line({ 80, 30, 60 }, { 46, 0, 90 }, 1);
  builder.Line({ 40, 0, 90 }, { 6, -30, 120 }, 1);
  const SkeletonGraph graph = builder.Graph();
  const RootHierarchy roots = RootsOf(graph);
  EXPECT_EQ(roots.axes.size(), 3U);
  const RootAxis & root = AxisTo(graph, roots, { 6, -30, 120 });
  EXPECT_EQ(root.level, 1);
  EXPECT_EQ(graph.positions[root.points.front()], (Spacing3{ 0, 0, 20 }));
}

// A pair across a thick root is worth less: bent by 60 degrees, thin roots are one root only beside a thin one.
TEST(RootTurning, ThinRootsToBothSidesOfAThickOneSpringFromIt)
{
  for (const double radius : { 1.0, 4.0 })
  {
    GraphBuilder builder;
    builder.Line({ 0, 0, 100 }, { 0, 0, 50 }, radius);
    builder.Line({ 0, 0, 50 }, { 0, 0, 0 }, radius);
    builder.Line({ 0, 0, 50 }, { 40, 0, 50 }, 1);
    builder.Line({ 0, 0, 50 }, { -20, 34, 50 }, 1);
    const SkeletonGraph graph = builder.Graph();
    const RootBranches  branches(graph);
    const ElementIndex  stem = BranchOf(graph, { 0, 0, 100 }, { 0, 0, 50 });
    const ElementIndex  arriving = BranchOf(graph, { 40, 0, 50 }, { 0, 0, 50 });
    const auto          endAt = [&](ElementIndex branch, const Spacing3 & place) {
      const bool isFirst = graph.positions[graph.Branch(branch).front()] == place;
      return BranchEnd{ branch, static_cast<std::uint8_t>(isFirst ? 0 : 1) };
    };
    const RootFlow     flow = FlowFrom(branches, { endAt(stem, { 0, 0, 100 }), endAt(arriving, { 40, 0, 50 }) });
    const RootPairing  pairing = PairBranches(branches, flow, {}, true);
    const ElementIndex leaving = BranchOf(graph, { 0, 0, 50 }, { -20, 34, 50 });
    EXPECT_EQ(pairing.next[stem], BranchOf(graph, { 0, 0, 50 }, { 0, 0, 0 }));
    EXPECT_EQ(pairing.next[arriving] == leaving, radius < 2) << radius;
  }
}

TEST(RootTurning, WhereThicknessSaysNothingTheLongerGoesOn)
{
  for (const double longer : { -1.0, 1.0 })
  {
    GraphBuilder builder;
    builder.Line({ 0, 0, 100 }, { 0, 0, 60 }, 1);
    builder.Line({ 0, 0, 60 }, { 30 * longer, 0, 30 }, 1);
    builder.Line({ 0, 0, 60 }, { -20 * longer, 0, 40 }, 1);
    const SkeletonGraph graph = builder.Graph();
    const RootHierarchy roots = RootsOf(graph);
    ASSERT_EQ(roots.axes.size(), 2U);
    EXPECT_EQ(graph.positions[roots.axes[0].points.back()][0], 30 * longer);
  }
}

TEST(RootTurning, TheLengthBeyondABranchIsThatOfTheLongestWay)
{
  const SkeletonGraph graph = LateralOfALateralThatTouches();
  const RootBranches  branches(graph);
  const RootFlow      flow = FlowFrom(branches, { StemOf(graph) });
  const auto          beyond = LengthsBeyond(branches, flow);
  for (ElementIndex branch = 0; branch < graph.BranchCount(); ++branch)
  {
    double longest = 0;
    for (ElementIndex tip = 0; tip < graph.BranchCount(); ++tip)
    {
      double length = 0;
      for (ElementIndex at = tip; at != kNoRoot; at = flow.before[at])
      {
        length += branches.LengthOf(at);
        longest = at == branch ? std::max(longest, length) : longest;
      }
    }
    EXPECT_NEAR(beyond[branch], longest, 1e-9);
  }
}

} // namespace
} // namespace voxelcore::testing
