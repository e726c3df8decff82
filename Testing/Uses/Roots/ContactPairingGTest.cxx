#include "ContactPairing.h"
#include "RootStem.h"

#include "Core/Skeleton/GraphBuilder.h"

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

StemWay
StemOf(const SkeletonGraph & graph)
{
  const RootBranches branches(graph);
  return FindStems(branches, Vector3{ 0, 0, 1 }, {}).front();
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

constexpr Spacing3 kTouch{ 40, 0, 20 };
constexpr Spacing3 kFork{ 20, -10, 45 };

/** A stem with a lateral that touches the lateral of a lower one, which is there after fewer mm and more forks. */
SkeletonGraph
LateralOfALateralThatTouches()
{
  GraphBuilder builder;
  builder.Line({ 0, 0, 120 }, { 0, 0, 100 }, 4);
  builder.Line({ 0, 0, 100 }, { 0, 0, 60 }, 4);
  builder.Line({ 0, 0, 60 }, { 0, 0, 0 }, 4);
  builder.Line({ 0, 0, 100 }, kTouch, 1);
  builder.Line(kTouch, { 60, 0, -20 }, 1);
  builder.Line({ 0, 0, 60 }, kFork, 1);
  builder.Line(kFork, { 60, -30, 15 }, 1);
  builder.Line(kFork, kTouch, 1);
  builder.Line(kTouch, { 60, 10, -5 }, 1);
  return builder.Graph();
}

TEST(ContactPairing, ARootIsNotRunThroughBackwardsFromWhereItTouchesAnother)
{
  const SkeletonGraph graph = LateralOfALateralThatTouches();
  const RootFlow      flow = FlowFrom(RootBranches(graph), { StemOf(graph) });
  EXPECT_TRUE(LeadsFrom(graph, flow, BranchOf(graph, kFork, kTouch), kFork));
  EXPECT_TRUE(LeadsFrom(graph, flow, BranchOf(graph, { 0, 0, 100 }, kTouch), { 0, 0, 100 }));
}

TEST(ContactPairing, ALateralThatTouchesAnotherSpringsWhereItMeetsItsParent)
{
  const SkeletonGraph graph = LateralOfALateralThatTouches();
  const RootHierarchy roots = RootsOf(graph);
  EXPECT_EQ(roots.axes.size(), 4U);
  const RootAxis & lateral = AxisTo(graph, roots, { 60, 10, -5 });
  EXPECT_EQ(graph.positions[lateral.points.front()], kFork);
  EXPECT_EQ(lateral.level, 2);
  EXPECT_EQ(AxisTo(graph, roots, { 60, 0, -20 }).level, 1);
  EXPECT_EQ(roots.meetings.size(), 1U);
}

// However crooked a stem is, a lateral that springs from it is not reached from another lateral before.
TEST(ContactPairing, LateralsCostTheSameAllAlongACrookedStem)
{
  constexpr Spacing3 touch{ 40, 0, 60 };
  GraphBuilder       builder;
  const auto         at = [](int k) { return Spacing3{ k % 2 == 0 ? 0.0 : -6.0, 0, 130.0 - 10 * k }; };
  builder.Line({ 0, 0, 150 }, at(0), 3);
  for (int k = 0; k < 7; ++k)
  {
    builder.Line(at(k), at(k + 1), 3);
    if (k > 0 && k < 6)
    {
      builder.Line(at(k), { at(k)[0] - 20, 0, at(k)[2] }, 0.5);
    }
  }
  builder.Line(at(0), touch, 1);
  builder.Line(at(6), touch, 1);
  builder.Line(touch, { 65, 0, 16 }, 1);
  builder.Line(touch, { 80, 0, 50 }, 1);
  const SkeletonGraph graph = builder.Graph();
  const RootFlow      flow = FlowFrom(RootBranches(graph), { StemOf(graph) });
  EXPECT_TRUE(LeadsFrom(graph, flow, BranchOf(graph, at(0), touch), at(0)));
  EXPECT_TRUE(LeadsFrom(graph, flow, BranchOf(graph, at(6), touch), at(6)));
}

TEST(ContactPairing, WhereThicknessSaysNothingTheLongerGoesOn)
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

TEST(ContactPairing, TheLengthBeyondABranchIsThatOfTheLongestWay)
{
  const SkeletonGraph graph = LateralOfALateralThatTouches();
  const RootBranches  branches(graph);
  const RootFlow      flow = FlowFrom(branches, { StemOf(graph) });
  const auto          beyond = FindWhatFollows(branches, flow);
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
    EXPECT_NEAR(beyond[branch].length, longest, 1e-9);
  }
}

} // namespace
} // namespace voxelcore::testing
