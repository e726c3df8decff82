#include "Core/Skeleton/GraphBuilder.h"

#include "voxelcore/Roots/RootHierarchy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

namespace voxelcore::testing
{
namespace
{

/** A stem with two laterals that run into each other at (30, 0, 50) and go on beyond; `touch` is what they share. */
GraphBuilder
TouchingRoots(const Spacing3 & touch)
{
  GraphBuilder builder;
  builder.Line({ 0, 0, 120 }, { 0, 0, 100 }, 4);
  builder.Line({ 0, 0, 100 }, { 0, 0, 40 }, 4);
  builder.Line({ 0, 0, 40 }, { 0, 0, 0 }, 3);
  const Spacing3 a{ 40 - touch[0] / 2, -touch[1] / 2, 70 - touch[2] / 2 };
  const Spacing3 b{ 40 + touch[0] / 2, touch[1] / 2, 70 + touch[2] / 2 };
  builder.Line({ 0, 0, 100 }, a, 2); // goes down and out
  builder.Line({ 0, 0, 40 }, a, 1);
  if (a != b)
  {
    builder.Line(a, b, 2);
  }
  builder.Line(b, { 80, 0, 40 }, 2);
  builder.Line(b, { 80, 0, 100 }, 1);
  return builder;
}

std::vector<std::int32_t>
Levels(const RootHierarchy & roots)
{
  std::vector<std::int32_t> levels;
  for (const RootAxis & axis : roots.axes)
  {
    levels.push_back(axis.level);
  }
  return levels;
}

Spacing3
TipOf(const SkeletonGraph & graph, const RootAxis & axis)
{
  return graph.positions[axis.points.back()];
}

} // namespace

/** A stem, a lateral that is torn between `from` and `to` and beyond that hangs on another, thinner by `likeness`. */
SkeletonGraph
TornRoot(const Spacing3 & from, const Spacing3 & to, double likeness)
{
  GraphBuilder builder;
  builder.Line({ 0, 0, 120 }, { 0, 0, 100 }, 4);
  builder.Line({ 0, 0, 100 }, { 0, 0, 40 }, 4);
  builder.Line({ 0, 0, 40 }, { 0, 0, 0 }, 3);
  builder.Line({ 0, 0, 100 }, from, 1.5);
  builder.Line(to, { 60, 0, 100 }, 1.5 * likeness);
  builder.Line({ 0, 0, 40 }, { 60, 0, 100 }, 1.5);
  builder.Line({ 60, 0, 100 }, { 80, 0, 120 }, 1.5);
  return builder.Graph();
}

TEST(RootHierarchy, ATornRootIsOneAgain)
{
  SkeletonGraph graph = TornRoot({ 30, 0, 100 }, { 34, 1, 100 }, 0.9);
  EXPECT_EQ(Levels(FindRoots(graph)), (std::vector<std::int32_t>{ 0, 1, 1, 2 })) << "its end springs from the other";
  const auto gaps = JoinTornRoots(graph);
  ASSERT_EQ(gaps.size(), 1U);
  EXPECT_DOUBLE_EQ(gaps[0], std::sqrt(17.0));
  const RootHierarchy roots = FindRoots(graph);
  EXPECT_EQ(Levels(roots), (std::vector<std::int32_t>{ 0, 1, 1 }));
  EXPECT_EQ(roots.meetings.size(), 1U) << "where it touches the other";
  EXPECT_TRUE(JoinTornRoots(graph).empty()) << "once is enough";
}

TEST(RootHierarchy, TipsThatDoNotFaceEachOtherNearAndAlikeStayApart)
{
  RootRules none;
  none.tornGap = 0;
  const auto joins = [](SkeletonGraph graph, const RootRules & rules) { return JoinTornRoots(graph, rules).size(); };
  EXPECT_EQ(joins(TornRoot({ 30, 0, 100 }, { 34, 0, 100 }, 1), {}), 1U);
  EXPECT_EQ(joins(TornRoot({ 30, 0, 100 }, { 34, 0, 100 }, 1), none), 0U);
  EXPECT_EQ(joins(TornRoot({ 30, 0, 100 }, { 37, 0, 100 }, 1), {}), 0U) << "more than twice the sum of radii";
  EXPECT_EQ(joins(TornRoot({ 30, 0, 100 }, { 32, 4, 100 }, 1), {}), 0U) << "beside it";
  EXPECT_EQ(joins(TornRoot({ 30, 0, 100 }, { 27, 0, 100 }, 1), {}), 0U) << "past it";
  EXPECT_EQ(joins(TornRoot({ 30, 0, 100 }, { 33, 0, 100 }, 0.4), {}), 0U) << "much thinner";
  EXPECT_EQ(joins(SmallRoot().Graph(), {}), 0U);
}

TEST(RootHierarchy, TipsThatOverlapFaceEachOther)
{
  // A gap shorter than a radius has no direction: one tip may lie beside the other, or a little past it.
  const auto joins = [](const Spacing3 & to) {
    SkeletonGraph graph = TornRoot({ 30, 0, 100 }, to, 1);
    return JoinTornRoots(graph).size();
  };
  EXPECT_EQ(joins({ 30, 0.6, 100 }), 1U);
  EXPECT_EQ(joins({ 29.6, 0.3, 100 }), 1U);
  RootRules rules;
  rules.tornSlack = 3;
  SkeletonGraph graph = TornRoot({ 30, 0, 100 }, { 37, 0, 100 }, 1);
  EXPECT_EQ(JoinTornRoots(graph, rules).size(), 1U) << "thick slices";
}

TEST(RootHierarchy, ATipThatRunsIntoTheSideOfARootGoesOnBeyondIt)
{
  // A lateral that is lost before another, thinner than a slice, and comes out of it on the other side.
  const auto graphWith = [](double gap) {
    GraphBuilder builder;
    builder.Line({ 0, 0, 120 }, { 0, 0, 100 }, 4);
    builder.Line({ 0, 0, 100 }, { 0, 0, 40 }, 4);
    builder.Line({ 0, 0, 40 }, { 0, 0, 0 }, 3);
    builder.Line({ 0, 0, 100 }, { 40 - gap, 0, 80 }, 1);
    builder.Line({ 0, 0, 40 }, { 41, 0, 79.5 }, 1);
    builder.Line({ 41, 0, 79.5 }, { 60, 0, 98 }, 1);
    builder.Line({ 41, 0, 79.5 }, { 80, 0, 60 }, 1);
    return builder.Graph();
  };
  RootRules rules;
  rules.tornSlack = 2;
  SkeletonGraph graph = graphWith(3);
  ASSERT_EQ(JoinTornRoots(graph, rules).size(), 1U);
  const RootHierarchy roots = FindRoots(graph, rules);
  EXPECT_EQ(Levels(roots), (std::vector<std::int32_t>{ 0, 1, 1 }));
  EXPECT_EQ(roots.meetings.size(), 1U);
  graph = graphWith(8);
  EXPECT_TRUE(JoinTornRoots(graph, rules).empty()) << "it ends before it";
  graph = graphWith(3);
  EXPECT_TRUE(JoinTornRoots(graph).empty()) << "a skeleton without slices";
}

TEST(RootHierarchy, AStretchWhoseCrossSectionIsSharedOutIsAsThickAsItsBalls)
{
  GraphBuilder builder;
  builder.Line({ 0, 0, 60 }, { 0, 0, 40 }, 3);
  builder.Line({ 0, 0, 40 }, { 0, 0, 36 }, 3);
  builder.Line({ 0, 0, 36 }, { 0, 0, 0 }, 3);
  builder.Line({ 0, 0, 40 }, { 8, 0, 8 }, 1.5);
  builder.Line({ 0, 0, 36 }, { -8, 0, 4 }, 1.5);
  SkeletonGraph graph = builder.Graph();
  graph.sectionRadius = graph.radius;
  for (std::size_t point = 0; point < graph.positions.size(); ++point)
  {
    const Spacing3 & at = graph.positions[point];
    graph.sectionRadius[point] = at[0] == 0 && at[2] > 36.5 && at[2] < 39.5 ? 0.3 : graph.radius[point];
  }
  const RootHierarchy roots = FindRoots(graph);
  EXPECT_EQ(Levels(roots), (std::vector<std::int32_t>{ 0, 1, 1 }));
  EXPECT_EQ(TipOf(graph, roots.axes[0]), (Spacing3{ 0, 0, 0 }));
}

TEST(RootHierarchy, ATreeHasItsStemLateralsAndTheirs)
{
  const SkeletonGraph graph = SmallRoot().Graph();
  const RootHierarchy roots = FindRoots(graph);
  EXPECT_TRUE(roots.upFound);
  EXPECT_EQ(roots.up, (Vector3{ 0, 0, 1 }));
  EXPECT_EQ(Levels(roots), (std::vector<std::int32_t>{ 0, 1, 1, 2 }));
  EXPECT_EQ(graph.positions[roots.axes[0].points.front()], (Spacing3{ 0, 0, 60 }));
  EXPECT_EQ(TipOf(graph, roots.axes[0]), (Spacing3{ 0, 0, 0 }));
  EXPECT_EQ(roots.axes[0].children, 2);
  EXPECT_EQ(roots.axes[3].parent == 1 || roots.axes[3].parent == 2, true);
  EXPECT_EQ(TipOf(graph, roots.axes[3]), (Spacing3{ 0, 20, 10 }));
  EXPECT_TRUE(roots.meetings.empty());
  for (const RootAxis & axis : roots.axes)
  {
    if (axis.parent != kNoRoot)
    {
      const RootAxis & parent = roots.axes[axis.parent];
      EXPECT_EQ(graph.positions[parent.points[axis.parentPoint]], graph.positions[axis.points.front()]);
    }
  }
}

TEST(RootHierarchy, UpIsAlongAnyAxis)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (const double sign : { 1.0, -1.0 })
    {
      SkeletonGraph graph = SmallRoot().Graph();
      for (auto & place : graph.positions)
      {
        Spacing3 turned{ place[0], place[1], place[2] };
        std::swap(turned[axis], turned[2]);
        turned[axis] *= sign;
        place = turned;
      }
      Vector3 up{};
      up[axis] = sign;
      const RootHierarchy roots = FindRoots(graph);
      EXPECT_EQ(roots.up, up);
      EXPECT_EQ(Levels(roots), (std::vector<std::int32_t>{ 0, 1, 1, 2 }));
      RootRules rules;
      rules.up = up;
      EXPECT_EQ(Levels(FindRoots(graph, rules)), Levels(roots));
      EXPECT_FALSE(FindRoots(graph, rules).upFound);
    }
  }
}

TEST(RootHierarchy, CrossingRootsGoOnAsThemselvesWhateverTheyShare)
{
  for (const Spacing3 & touch : { Spacing3{ 0, 0, 0 }, Spacing3{ 6, 0, 0 } })
  {
    const SkeletonGraph graph = TouchingRoots(touch).Graph();
    const RootHierarchy roots = FindRoots(graph);
    ASSERT_EQ(Levels(roots), (std::vector<std::int32_t>{ 0, 1, 1 }));
    for (const RootAxis & axis : roots.axes)
    {
      const Spacing3 tip = TipOf(graph, axis);
      const Spacing3 base = graph.positions[axis.points.front()];
      EXPECT_FALSE(axis.endsAtContact);
      if (axis.level == 1)
      {
        EXPECT_EQ(tip[2], base[2] == 100 ? 40 : 100); // straight across
      }
    }
    ASSERT_EQ(roots.meetings.size(), 1U);
    EXPECT_EQ(roots.meetings[0].pairs.size(), 2U);
    EXPECT_FALSE(roots.meetings[0].undecided);
    EXPECT_NEAR(roots.meetings[0].position[0], 40, 1e-9);
  }
}

TEST(RootHierarchy, ABridgeBetweenTwoRootsIsNoRoot)
{
  GraphBuilder builder;
  builder.Line({ 0, 0, 100 }, { 0, 0, 90 }, 4);
  builder.Line({ 0, 0, 90 }, { 0, 0, 0 }, 4);
  builder.Line({ 0, 0, 90 }, { 40, 0, 60 }, 2);
  builder.Line({ 40, 0, 60 }, { 80, 0, 30 }, 2);
  builder.Line({ 0, 0, 90 }, { 40, 5, 62 }, 2);
  builder.Line({ 40, 5, 62 }, { 80, 40, 40 }, 2);
  builder.Line({ 40, 0, 60 }, { 40, 5, 62 }, 1);
  const SkeletonGraph graph = builder.Graph();
  const RootHierarchy roots = FindRoots(graph);
  EXPECT_EQ(Levels(roots), (std::vector<std::int32_t>{ 0, 1, 1 }));
  EXPECT_EQ(std::count(roots.rootOf.begin(), roots.rootOf.end(), kNoRoot), 1);
  ASSERT_EQ(roots.meetings.size(), 1U);
}

/** A lateral that runs up beside another, joined to it by what is `away` long. */
SkeletonGraph
BesideEachOther(double away)
{
  const Spacing3 onFirst{ 0, 14, 42 };
  const Spacing3 onSecond{ 0.6 * away, 14, 42 - 0.8 * away };
  GraphBuilder   builder;
  builder.Line({ -60, 0, 160 }, { -60, 0, 120 }, 8);
  builder.Line({ -60, 0, 120 }, { -60, 0, 0 }, 8);
  builder.Line({ -60, 0, 120 }, { 0, 0, 150 }, 4);
  builder.Line({ 0, 0, 150 }, { 0, 0, 100 }, 4);
  builder.Line({ 0, 0, 100 }, { 0, 0, 20 }, 4);
  builder.Line({ 0, 0, 20 }, { 0, 0, -40 }, 4);
  builder.Line({ 0, 0, 100 }, onFirst, 2);
  builder.Line(onFirst, { 0, 27, 0 }, 2);
  builder.Line({ 0, 0, 20 }, onSecond, 2);
  builder.Line(onSecond, { 20, 40, 80 }, 2);
  builder.Line(onFirst, onSecond, 1);
  return builder.Graph();
}

TEST(RootHierarchy, WhatLeadsFromARootToAnotherIsNoRootUnlessItIsLong)
{
  for (const double away : { 6.0, 12.0 })
  {
    const SkeletonGraph graph = BesideEachOther(away);
    const RootHierarchy roots = FindRoots(graph);
    const bool          isBridge = away < 2 * 1.6 * 2;
    EXPECT_EQ(roots.axes.size(), isBridge ? 4U : 5U) << away;
    EXPECT_EQ(std::ranges::count(roots.leftOut, LeftOut::Bridge), isBridge ? 1 : 0) << away;
    ASSERT_EQ(roots.meetings.size(), 1U) << away;
    // Its contact reaches from one to the other.
    EXPECT_GT(roots.meetings[0].reach, isBridge ? away : 0) << away;
  }
}

TEST(RootHierarchy, ARootThatEndsAtAnotherEndsThere)
{
  GraphBuilder builder;
  builder.Line({ 0, 0, 100 }, { 0, 0, 90 }, 4);
  builder.Line({ 0, 0, 90 }, { 0, 0, 30 }, 4);
  builder.Line({ 0, 0, 30 }, { 0, 0, 0 }, 4);
  builder.Line({ 0, 0, 90 }, { 40, 0, 60 }, 2);
  builder.Line({ 40, 0, 60 }, { 80, 0, 30 }, 2);
  builder.Line({ 0, 0, 30 }, { 40, 0, 60 }, 1); // from below into the side of the other
  const RootHierarchy roots = FindRoots(builder.Graph());
  ASSERT_EQ(Levels(roots), (std::vector<std::int32_t>{ 0, 1, 1 }));
  EXPECT_EQ(roots.axes[1].endsAtContact + roots.axes[2].endsAtContact, 1);
}

TEST(RootHierarchy, EqualArmsInACrossAreMarkedUndecided)
{
  // Seen from the contact all four arms lie at right angles in space: each pairing is as good as the other.
  GraphBuilder builder;
  builder.Line({ 0, 0, 100 }, { 0, 0, 60 }, 4);
  builder.Line({ 0, 0, 60 }, { 0, 0, 0 }, 4);
  builder.Line({ 0, 0, 60 }, { 20, 40, 30 }, 2);
  builder.Line({ 20, 40, 30 }, { 50, 0, 30 }, 2);
  builder.Line({ 0, 0, 60 }, { 20, -40, 30 }, 2);
  builder.Line({ 20, -40, 30 }, { 50, 0, 30 }, 2);
  builder.Line({ 50, 0, 30 }, { 90, 0, 70 }, 2);
  builder.Line({ 50, 0, 30 }, { 90, 0, -10 }, 2);
  const RootHierarchy roots = FindRoots(builder.Graph());
  ASSERT_EQ(roots.meetings.size(), 1U);
  EXPECT_TRUE(roots.meetings[0].undecided);
  EXPECT_LT(roots.meetings[0].margin, 1e-9);
  EXPECT_EQ(std::count_if(roots.axes.begin(), roots.axes.end(), [](const RootAxis & axis) { return axis.undecided; }),
            2);
}

TEST(RootHierarchy, SeveralStemsAreTakenAsAskedOrFound)
{
  GraphBuilder builder;
  builder.Line({ 0, 0, 100 }, { 0, 0, 50 }, 4);
  builder.Line({ 60, 0, 100 }, { 60, 0, 50 }, 3.5);
  builder.Line({ 0, 0, 50 }, { 60, 0, 50 }, 1.5);
  builder.Line({ 0, 0, 50 }, { 0, 0, 0 }, 3);
  builder.Line({ 60, 0, 50 }, { 60, 0, 0 }, 3);
  const SkeletonGraph graph = builder.Graph();
  RootRules           rules;
  rules.up = Vector3{ 0, 0, 1 };
  EXPECT_EQ(Levels(FindRoots(graph, rules))[1], 1);
  rules.stems = 2;
  const RootHierarchy two = FindRoots(graph, rules);
  EXPECT_EQ(two.axes[0].level + two.axes[1].level, 0);
  EXPECT_EQ(TipOf(graph, two.axes[1])[2], 0);
  rules.stems = 0;
  EXPECT_EQ(Levels(FindRoots(graph, rules)), Levels(two));
}

TEST(RootHierarchy, AStemIsWhereItIsSaidToBe)
{
  GraphBuilder builder;
  builder.Line({ 0, 0, 100 }, { 0, 0, 50 }, 8);
  builder.Line({ 0, 0, 50 }, { 0, 0, 0 }, 8);
  builder.Line({ 0, 0, 50 }, { 60, 0, 50 }, 2);
  builder.Line({ 60, 0, 50 }, { 60, 0, 0 }, 2);
  builder.Line({ 60, 0, 50 }, { 90, 0, 90 }, 2);
  const SkeletonGraph graph = builder.Graph();
  RootRules           rules;
  EXPECT_EQ(TipOf(graph, FindRoots(graph, rules).axes[0])[0], 0);
  rules.stem = { { 88, 1, 92 } };
  EXPECT_EQ(graph.positions[FindRoots(graph, rules).axes[0].points.front()], (Spacing3{ 90, 0, 90 }));
  rules.stem = { { 1, 0, 99 }, { 61, 0, 2 } };
  const RootHierarchy roots = FindRoots(graph, rules);
  EXPECT_EQ(graph.positions[roots.axes[0].points.front()], (Spacing3{ 0, 0, 100 }));
  EXPECT_EQ(TipOf(graph, roots.axes[0]), (Spacing3{ 60, 0, 0 }));
}

TEST(RootHierarchy, AStemRunsOnThroughShortPiecesThatTurnWithinItsNode)
{
  const Spacing3 below{ 0, 0, 52 };
  const Spacing3 above{ 5, 0, 53 };
  GraphBuilder   builder;
  builder.Line({ 0, 0, 0 }, below, 10);
  builder.Line(below, above, 10);
  builder.Line(above, { 5, 0, 68 }, 10);
  builder.Line(above, { 15, 0, 53 }, 10); // bulges to both sides, straight on from the short piece
  builder.Line(below, { -12, 0, 51 }, 10.5);
  builder.Line(below, { -40, 0, 10 }, 2);
  builder.Line(below, { 0, 40, 10 }, 2);
  const SkeletonGraph graph = builder.Graph();
  RootRules           rules;
  rules.up = Vector3{ 0, 0, 1 };
  const RootHierarchy roots = FindRoots(graph, rules);
  EXPECT_EQ(graph.positions[roots.axes[0].points.front()], (Spacing3{ 5, 0, 68 }));
  EXPECT_EQ(graph.positions[roots.axes[0].points.back()], (Spacing3{ 0, 0, 0 }));
}

TEST(RootHierarchy, APieceByItselfIsLoose)
{
  GraphBuilder builder = SmallRoot();
  builder.Line({ 100, 0, 10 }, { 120, 0, 10 }, 1);
  const RootHierarchy roots = FindRoots(builder.Graph());
  EXPECT_EQ(std::count_if(roots.axes.begin(), roots.axes.end(), [](const RootAxis & axis) { return axis.loose; }), 1);
  EXPECT_EQ(roots.axes.size(), 5U);
}

TEST(RootHierarchy, WhorlsAreLateralsFromOnePlace)
{
  GraphBuilder builder;
  builder.Line({ 0, 0, 100 }, { 0, 0, 80 }, 4);
  builder.Line({ 0, 0, 80 }, { 0, 0, 50 }, 4);
  builder.Line({ 0, 0, 50 }, { 0, 0, 48 }, 4);
  builder.Line({ 0, 0, 48 }, { 0, 0, 0 }, 4);
  for (const double z : { 80.0, 50.0 })
  {
    builder.Line({ 0, 0, z }, { 40, 0, z - 10 }, 1);
    builder.Line({ 0, 0, z }, { -40, 0, z - 10 }, 1);
    builder.Line({ 0, 0, z }, { 0, 40, z - 10 }, 1);
  }
  builder.Line({ 0, 0, 48 }, { 0, -40, 40 }, 1);
  RootRules rules;
  rules.up = Vector3{ 0, 0, 1 };
  const RootHierarchy roots = FindRoots(builder.Graph(), rules);
  ASSERT_EQ(roots.whorls.size(), 2U);
  EXPECT_EQ(roots.whorls[0].roots.size(), 3U);
  EXPECT_EQ(roots.whorls[1].roots.size(), 4U);
  EXPECT_NEAR(roots.whorls[0].along, 20, 1e-9);
  EXPECT_NEAR(roots.whorls[1].along, 50.5, 1e-9);
}

// Straight on is right, unless what lies beyond the other way is so much longer that it would be a level too far out.
TEST(RootHierarchy, ABranchGoesOnStraightUnlessMostOfTheRootLiesBeyondAnother)
{
  for (const double bent : { 60.0, 400.0 })
  {
    GraphBuilder builder;
    builder.Line({ 0, 0, 200 }, { 0, 0, 150 }, 10);
    builder.Line({ 0, 0, 150 }, { 0, 0, 0 }, 10);
    builder.Line({ 0, 0, 150 }, { 60, 0, 150 }, 2);
    builder.Line({ 60, 0, 150 }, { 90, 0, 150 }, 2);
    builder.Line({ 60, 0, 150 }, { 60 + bent / 2, 0, 150 - bent / 2 * std::sqrt(3.0) }, 2);
    const SkeletonGraph graph = builder.Graph();
    RootRules           rules;
    rules.up = Vector3{ 0, 0, 1 };
    const RootHierarchy roots = FindRoots(graph, rules);
    ASSERT_EQ(Levels(roots), (std::vector<std::int32_t>{ 0, 1, 2 }));
    EXPECT_EQ(TipOf(graph, roots.axes[1])[0], bent > 100 ? 60 + bent / 2 : 90);
  }
}

TEST(RootHierarchy, NoOtherChoiceAtAContactIsBetter)
{
  for (const Spacing3 & touch : { Spacing3{ 0, 0, 0 }, Spacing3{ 6, 0, 0 }, Spacing3{ 0, 3, 2 } })
  {
    for (const RootMeeting & meeting : FindRoots(TouchingRoots(touch).Graph()).meetings)
    {
      EXPECT_GT(meeting.margin, 0);
      EXPECT_EQ(meeting.arms.size(), 4U);
    }
  }
}

// Where a root comes back to itself it goes on as what it was before; the loop does not close on itself.
TEST(RootHierarchy, ARootThatTouchesItselfIsOneRoot)
{
  GraphBuilder builder;
  builder.Line({ 0, 0, 120 }, { 0, 0, 100 }, 4);
  builder.Line({ 0, 0, 100 }, { 0, 0, 0 }, 4);
  builder.Line({ 0, 0, 100 }, { 50, 0, 100 }, 2);
  builder.Line({ 50, 0, 100 }, { 50, 30, 100 }, 2); // round, and back to (50, 0, 100) the way it left
  builder.Line({ 50, 30, 100 }, { 50, 30, 60 }, 2);
  builder.Line({ 50, 30, 60 }, { 50, -30, 60 }, 2);
  builder.Line({ 50, -30, 60 }, { 50, -30, 100 }, 2);
  builder.Line({ 50, -30, 100 }, { 50, 0, 100 }, 2);
  builder.Line({ 50, 0, 100 }, { 110, 0, 100 }, 2);
  const SkeletonGraph graph = builder.Graph();
  const RootHierarchy roots = FindRoots(graph);
  for (const RootMeeting & meeting : roots.meetings)
  {
    for (const auto & pair : meeting.pairs)
    {
      EXPECT_NE(pair[0], pair[1]);
    }
  }
  for (const RootAxis & axis : roots.axes)
  {
    EXPECT_TRUE(axis.level == 0 || axis.parent != kNoRoot);
  }
}

TEST(RootHierarchy, TheReachOfAMeetingAtOneJunctionIsItsBallAndAFifth)
{
  const RootHierarchy roots = FindRoots(TouchingRoots({ 0, 0, 0 }).Graph());
  ASSERT_EQ(roots.meetings.size(), 1U);
  EXPECT_EQ(roots.meetings[0].radius, 2);
  EXPECT_DOUBLE_EQ(roots.meetings[0].reach, 2.4);
}

TEST(RootHierarchy, RootsOfAWhorlThatRunFusedNextToTheStemAllSpringFromIt)
{
  // 1.5 and 2.5 radii of a thick stem; next to a thin one, up to 3 radii of the root beyond it.
  for (const auto & [stem, fork, deepest] : { std::tuple{ 10.0, 15.0, 1 }, { 10, 25, 2 }, { 4, 12, 1 }, { 4, 16, 2 } })
  {
    GraphBuilder builder;
    builder.Line({ 0, 0, 100 }, { 0, 0, 50 }, stem);
    builder.Line({ 0, 0, 50 }, { 0, 0, 0 }, stem);
    builder.Line({ 0, 0, 50 }, { fork, 0, 50 }, 3);
    builder.Line({ fork, 0, 50 }, { fork + 60, 20, 50 }, 2.5);
    builder.Line({ fork, 0, 50 }, { fork + 60, -30, 40 }, 2.4);
    RootRules rules;
    rules.up = Vector3{ 0, 0, 1 };
    const RootHierarchy roots = FindRoots(builder.Graph(), rules);
    ASSERT_EQ(roots.axes.size(), 3U);
    EXPECT_EQ(roots.axes.back().level, deepest) << stem << ' ' << fork;
  }
}

TEST(RootHierarchy, NothingHasNoRoots)
{
  EXPECT_TRUE(FindRoots(SkeletonGraph()).axes.empty());
}

} // namespace voxelcore::testing
