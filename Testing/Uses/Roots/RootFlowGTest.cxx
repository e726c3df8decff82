#include "RootStem.h"

#include "Core/Skeleton/GraphBuilder.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace voxelcore::testing
{
namespace
{

/** The end of a branch that lies there, of the branch that also ends at `other`. */
BranchEnd
EndAt(const SkeletonGraph & graph, const Spacing3 & place, const Spacing3 & other)
{
  for (ElementIndex branch = 0; branch < graph.BranchCount(); ++branch)
  {
    const auto       points = graph.Branch(branch);
    const Spacing3 & first = graph.positions[points.front()];
    const Spacing3 & last = graph.positions[points.back()];
    if ((first == place && last == other) || (last == place && first == other))
    {
      return { branch, static_cast<std::uint8_t>(first == place ? 0 : 1) };
    }
  }
  ADD_FAILURE() << "no branch leads there";
  return {};
}

// A swelling, or a stub within it, is thick and not long: the stem is the thick way that is long, from its thick end.
TEST(RootFlow, AStemIsTheThickLongWay)
{
  GraphBuilder builder;
  builder.Line({ 0, 0, 0 }, { 4, 0, 0 }, 6);
  builder.Line({ 4, 0, 0 }, { 60, 0, 0 }, 1);
  builder.Line({ 60, 0, 0 }, { 60, 60, 0 }, 4);
  builder.Line({ 60, 0, 0 }, { 120, 0, 0 }, 3);
  builder.Line({ 4, 0, 0 }, { 4, 10, 0 }, 0.5);
  const SkeletonGraph graph = builder.Graph();
  const RootBranches  branches(graph);
  const auto          stems = FindStems(branches, std::nullopt, {});
  ASSERT_EQ(stems.size(), 1U);
  ASSERT_EQ(stems[0].size(), 2U) << "it does not go on into what is much thinner";
  EXPECT_EQ(graph.positions[branches.PointFrom(stems[0][0], 0)], (Spacing3{ 60, 60, 0 }));
  EXPECT_EQ(graph.positions[branches.PointFrom(stems[0][1].Other(), 0)], (Spacing3{ 120, 0, 0 }));
}

// A column with spokes at its nodes, roots at its foot much thinner than it, and a root that stands up from its head.
TEST(RootFlow, AStemGoesStraightThroughItsNodesAndEndsWhereOnlyRootsGoOn)
{
  GraphBuilder builder;
  builder.Line({ 0, 0, 100 }, { 0, 0, 70 }, 10);
  builder.Line({ 0, 0, 70 }, { 0, 0, 40 }, 9);
  builder.Line({ 0, 0, 40 }, { 0, 0, 20 }, 8);
  for (const double z : { 70.0, 40.0, 20.0 })
  {
    for (const double side : { -1.0, 1.0 })
    {
      builder.Line({ 0, 0, z }, { side * 80, 0, z - 60 }, 2);
      builder.Line({ 0, 0, z }, { 0, side * 80, z - 60 }, 2);
    }
  }
  const SkeletonGraph graph = builder.Graph();
  const RootHierarchy roots = FindRoots(graph);
  EXPECT_EQ(graph.positions[roots.axes[0].points.front()], (Spacing3{ 0, 0, 100 }));
  EXPECT_EQ(graph.positions[roots.axes[0].points.back()], (Spacing3{ 0, 0, 20 }));
  EXPECT_EQ(roots.axes.size(), 13U);
  EXPECT_EQ(roots.axes[0].children, 12);
}

// Of a whorl at its foot no root is the stem's own, however straight below; a taproot is, with its thin laterals.
TEST(RootFlow, AStemEndsWhereSeveralRootsAlikeGoOnAndRunsOnAsATaproot)
{
  for (const double other : { 2.0, 1.0 })
  {
    GraphBuilder builder;
    builder.Line({ 0, 0, 160 }, { 0, 0, 80 }, 8);
    builder.Line({ 0, 0, 80 }, { 0, 0, 60 }, 5);
    builder.Line({ 0, 0, 80 }, { 60, 0, 40 }, 1);
    builder.Line({ 0, 0, 60 }, { 0, 0, 0 }, 2.5);
    builder.Line({ 0, 0, 60 }, { 60, 0, 0 }, other);
    builder.Line({ 0, 0, 60 }, { -60, 0, 0 }, other);
    const SkeletonGraph graph = builder.Graph();
    const RootBranches  branches(graph);
    const auto          stems = FindStems(branches, Vector3{ 0, 0, 1 }, {});
    ASSERT_EQ(stems.size(), 1U);
    EXPECT_EQ(stems[0].size(), other > 1 ? 2U : 3U);
    EXPECT_EQ(FindRoots(graph).axes.size(), other > 1 ? 5U : 4U);
  }
}

// Whatever the stem begins at, no branch is left without a root but bridges between roots that touch.
TEST(RootFlow, BranchesAtTheBaseOfAStemSpringFromIt)
{
  GraphBuilder builder;
  builder.Line({ 0, 0, 100 }, { 0, 0, 40 }, 8);
  builder.Line({ 0, 0, 100 }, { 40, 0, 120 }, 1);
  builder.Line({ 0, 0, 100 }, { -40, 0, 120 }, 1);
  builder.Line({ 40, 0, 120 }, { 60, 0, 120 }, 1);
  builder.Line({ 40, 0, 120 }, { 40, 30, 120 }, 1);
  builder.Line({ 0, 0, 40 }, { 30, 0, 0 }, 1);
  builder.Line({ 0, 0, 40 }, { -30, 0, 0 }, 1);
  const SkeletonGraph graph = builder.Graph();
  const RootHierarchy roots = FindRoots(graph);
  EXPECT_EQ(std::count(roots.rootOf.begin(), roots.rootOf.end(), kNoRoot), 0);
  EXPECT_EQ(roots.axes[0].children, 4);
  EXPECT_EQ(roots.axes.size(), 6U);
}

// What springs from a lateral where that is still within the stem is a lateral of the stem.
TEST(RootFlow, RootsThatPartWithinTheStemSpringFromTheStem)
{
  for (const double away : { 6.0, 40.0 })
  {
    GraphBuilder builder;
    builder.Line({ 0, 0, 100 }, { 0, 0, 50 }, 10);
    builder.Line({ 0, 0, 50 }, { 0, 0, 0 }, 10);
    builder.Line({ 0, 0, 50 }, { away, 0, 50 }, 2);
    builder.Line({ away, 0, 50 }, { 90, 0, 20 }, 2);
    builder.Line({ away, 0, 50 }, { 90, 40, 50 }, 2);
    const RootHierarchy roots = FindRoots(builder.Graph());
    ASSERT_EQ(roots.axes.size(), 3U);
    EXPECT_EQ(roots.axes[2].level, away < 10 ? 1 : 2);
  }
}

TEST(RootFlow, ADirectionIsThatOutsideTheBallAtAJunction)
{
  // The ball reaches 4.2, directions begin at 1.2 times that: right at the bend after 5.
  GraphBuilder builder;
  builder.Line({ 0, 0, 0 }, { -20, 0, 0 }, 4.2);
  builder.Line({ 0, 0, 0 }, { 0, 0, -20 }, 4.2);
  builder.Line({ 0, 0, 0 }, { 5, 0, 0 }, 1);
  builder.Line({ 5, 0, 0 }, { 5, 30, 0 }, 1);
  const SkeletonGraph graph = builder.Graph();
  const RootBranches  branches(graph);
  const Vector3       way = branches.DirectionFrom(EndAt(graph, { 0, 0, 0 }, { 5, 30, 0 }));
  EXPECT_DOUBLE_EQ(way[0], 0);
  EXPECT_DOUBLE_EQ(way[1], 1);
  EXPECT_DOUBLE_EQ(way[2], 0);
}

TEST(RootFlow, TheDirectionOfAShortBranchLeadsFromItsEnd)
{
  GraphBuilder builder;
  builder.Line({ 0, 0, 0 }, { 1, 1, 0 }, 5);
  builder.Line({ 1, 1, 0 }, { 2, 0, 0 }, 5);
  const SkeletonGraph graph = builder.Graph();
  ASSERT_EQ(graph.BranchCount(), 1U);
  const RootBranches branches(graph);
  EXPECT_EQ(branches.DirectionFrom(EndAt(graph, { 0, 0, 0 }, { 2, 0, 0 })), (Vector3{ 1, 0, 0 }));
  EXPECT_EQ(branches.DirectionFrom(EndAt(graph, { 2, 0, 0 }, { 0, 0, 0 })), (Vector3{ -1, 0, 0 }));
}

// A junction of four branches may come as two a fraction of a millimetre apart, one behind the other.
TEST(RootFlow, TheDirectionOfAPieceWithinABallIsThatOfWhatItLeadsTo)
{
  GraphBuilder builder;
  builder.Line({ 0, 0, 0 }, { 0, 0, 40 }, 5);
  builder.Line({ 0, 0, 0 }, { 30, 0, -20 }, 2);
  builder.Line({ 0, 0, 0 }, { 0, 0.1, 0.2 }, 5); // backwards
  builder.Line({ 0, 0.1, 0.2 }, { -30, 0, -20 }, 2);
  builder.Line({ 0, 0.1, 0.2 }, { 0, 0, -40 }, 5);
  const SkeletonGraph graph = builder.Graph();
  const RootBranches  branches(graph);
  EXPECT_LT(branches.DirectionFrom(EndAt(graph, { 0, 0, 0 }, { 0, 0.1, 0.2 }))[2], -0.99);
  EXPECT_GT(branches.DirectionFrom(EndAt(graph, { 0, 0.1, 0.2 }, { 0, 0, 0 }))[2], 0.99);
  RootRules rules;
  rules.up = Vector3{ 0, 0, 1 };
  EXPECT_EQ(FindRoots(graph, rules).axes.size(), 3U);
  EXPECT_EQ(graph.positions[FindRoots(graph, rules).axes[0].points.back()], (Spacing3{ 0, 0, -40 }));
}

// Going straight on costs nothing however many laterals spring on the way; a lateral costs once.
TEST(RootFlow, AStraightStemIsRunThroughFromItsBaseWhateverLeavesIt)
{
  constexpr int last = 10;
  const auto    at = [](int k) { return Spacing3{ 0, 0, 120.0 - 10 * k }; };
  GraphBuilder  builder;
  builder.Line({ 0, 0, 130 }, at(0), 3);
  for (int k = 0; k < last; ++k)
  {
    builder.Line(at(k), at(k + 1), 3);
    if (k > 0)
    {
      builder.Line(at(k), { k % 2 == 0 ? 15.0 : -15.0, 0, at(k)[2] }, 0.5);
    }
  }
  builder.Line(at(last), { 0, 0, 0 }, 3);
  // A root that leaves the stem at its first junction and touches it again at the last.
  builder.Line(at(0), { 0, 40, 70 }, 1);
  builder.Line({ 0, 40, 70 }, at(last), 1);
  const SkeletonGraph graph = builder.Graph();
  const RootBranches  branches(graph);
  const RootFlow      flow = FlowFrom(branches, { { EndAt(graph, { 0, 0, 130 }, at(0)) } });
  ElementIndex        before = EndAt(graph, { 0, 0, 130 }, at(0)).branch;
  EXPECT_EQ(flow.before[before], kNoRoot);
  for (int k = 0; k <= last; ++k)
  {
    const BranchEnd base = EndAt(graph, at(k), k < last ? at(k + 1) : Spacing3{ 0, 0, 0 });
    EXPECT_EQ(flow.base[base.branch], base.last) << k;
    EXPECT_EQ(flow.before[base.branch], before) << k;
    before = base.branch;
  }
}

// Levels, parents and places do not depend on where a plant stands, which way it is turned and in what unit it is.
TEST(RootFlow, RootsAreTheSameMovedTurnedAndInAnotherUnit)
{
  const SkeletonGraph graph = SmallRoot().Graph();
  const RootHierarchy roots = FindRoots(graph);
  for (const double unit : { 1.0, 1.0 / 1024, 1024.0 })
  {
    for (const double away : { 0.0, -4096.0, 512.0 })
    {
      for (std::size_t turn = 0; turn < 3; ++turn)
      {
        SkeletonGraph other = graph;
        for (std::size_t point = 0; point < graph.positions.size(); ++point)
        {
          for (std::size_t axis = 0; axis < 3; ++axis)
          {
            other.positions[point][(axis + turn) % 3] = unit * (graph.positions[point][axis] + away);
          }
          other.radius[point] *= unit;
        }
        const RootHierarchy found = FindRoots(other);
        ASSERT_EQ(found.axes.size(), roots.axes.size()) << unit << ' ' << away << ' ' << turn;
        EXPECT_EQ(found.up[(2 + turn) % 3], 1);
        for (std::size_t axis = 0; axis < roots.axes.size(); ++axis)
        {
          EXPECT_EQ(found.axes[axis].points, roots.axes[axis].points) << unit << ' ' << away << ' ' << turn;
          EXPECT_EQ(found.axes[axis].parent, roots.axes[axis].parent);
        }
      }
    }
  }
}

} // namespace
} // namespace voxelcore::testing
