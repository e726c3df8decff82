#include "voxelcore/Roots/RootEdits.h"

#include "Core/Skeleton/GraphBuilder.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Roots/RootTraits.h"

#include <gtest/gtest.h>

namespace voxelcore::testing
{
namespace
{

using Kind = RootEdit::Kind;

/** The root of SmallRoot() whose tip lies there. */
ElementIndex
RootTo(const SkeletonGraph & graph, const RootHierarchy & roots, const Spacing3 & tip)
{
  for (ElementIndex axis = 0; axis < roots.axes.size(); ++axis)
  {
    if (graph.positions[roots.axes[axis].points.back()] == tip)
    {
      return axis;
    }
  }
  ADD_FAILURE() << "no root ends there";
  return kNoRoot;
}

double
LengthOf(const SkeletonGraph & graph, const RootAxis & axis)
{
  double length = 0;
  for (std::size_t i = 1; i < axis.points.size(); ++i)
  {
    length += Distance(graph.positions[axis.points[i - 1]], graph.positions[axis.points[i]]);
  }
  return length;
}

/** What holds for every hierarchy. */
void
ExpectSound(const SkeletonGraph & graph, const RootHierarchy & roots)
{
  std::vector<std::int32_t> children(roots.axes.size(), 0);
  for (ElementIndex i = 0; i < roots.axes.size(); ++i)
  {
    const RootAxis & axis = roots.axes[i];
    EXPECT_GE(axis.points.size(), 2U);
    EXPECT_TRUE(i == 0 || roots.axes[i - 1].level <= axis.level);
    if (axis.parent == kNoRoot)
    {
      EXPECT_EQ(axis.level, 0);
      EXPECT_EQ(axis.stem, i);
      continue;
    }
    ASSERT_LT(axis.parent, i);
    const RootAxis & parent = roots.axes[axis.parent];
    EXPECT_EQ(axis.level, parent.level + 1);
    EXPECT_EQ(axis.stem, parent.stem);
    ASSERT_LT(axis.parentPoint, parent.points.size());
    ++children[axis.parent];
  }
  for (std::size_t branch = 0; branch < roots.rootOf.size(); ++branch)
  {
    if (roots.rootOf[branch] != kNoRoot)
    {
      const auto & points = roots.axes[roots.rootOf[branch]].points;
      EXPECT_NE(std::ranges::find(points, graph.Branch(branch)[graph.Branch(branch).size() / 2]), points.end());
    }
  }
  for (ElementIndex i = 0; i < roots.axes.size(); ++i)
  {
    EXPECT_EQ(roots.axes[i].children, children[i]);
  }
}

class RootEdits : public ::testing::Test
{
protected:
  SkeletonGraph m_Graph = SmallRoot().Graph();
  RootHierarchy m_Roots = FindRoots(m_Graph);
  ElementIndex  m_Side = RootTo(m_Graph, m_Roots, { 30, 0, 40 });
  ElementIndex  m_Long = RootTo(m_Graph, m_Roots, { 0, 40, 20 });
  ElementIndex  m_Small = RootTo(m_Graph, m_Roots, { 0, 20, 10 });
};

TEST_F(RootEdits, WithoutAnyNothingChanges)
{
  const EditedRoots edited = EditRoots(m_Graph, m_Roots, {});
  ASSERT_EQ(edited.roots.axes.size(), m_Roots.axes.size());
  for (ElementIndex i = 0; i < m_Roots.axes.size(); ++i)
  {
    EXPECT_EQ(edited.now[i], i);
    EXPECT_EQ(edited.roots.axes[i].points, m_Roots.axes[i].points);
    EXPECT_EQ(edited.roots.axes[i].parent, m_Roots.axes[i].parent);
  }
  EXPECT_EQ(edited.roots.rootOf, m_Roots.rootOf);
  ExpectSound(m_Graph, edited.roots);
}

TEST_F(RootEdits, ARootIsRemovedWithWhatSpringsFromIt)
{
  const RootEdit    edit{ m_Long, Kind::Remove };
  const EditedRoots edited = EditRoots(m_Graph, m_Roots, { &edit, 1 });
  ExpectSound(m_Graph, edited.roots);
  EXPECT_EQ(edited.roots.axes.size(), 2U);
  EXPECT_EQ(edited.now[m_Long], kNoRoot);
  EXPECT_EQ(edited.now[m_Small], kNoRoot);
  EXPECT_EQ(edited.roots.axes[0].children, 1);
  EXPECT_EQ(std::ranges::count(edited.roots.rootOf, kNoRoot), 3) << "two branches of one root, one of the other";
  // Unless it is said to spring from another.
  const std::vector<RootEdit> moved{ edit, { m_Small, Kind::Parent, 0 } };
  const EditedRoots           other = EditRoots(m_Graph, m_Roots, moved);
  ExpectSound(m_Graph, other.roots);
  ASSERT_NE(other.now[m_Small], kNoRoot);
  EXPECT_EQ(other.roots.axes[other.now[m_Small]].level, 1);
}

TEST_F(RootEdits, AtAJunctionAnotherBranchGoesOnAndTheFormerOneBecomesItsLateral)
{
  const RootEdit    edit{ m_Small, Kind::Continues, m_Long };
  const EditedRoots edited = EditRoots(m_Graph, m_Roots, { &edit, 1 });
  ExpectSound(m_Graph, edited.roots);
  ASSERT_EQ(edited.roots.axes.size(), m_Roots.axes.size());
  const ElementIndex whole = RootTo(m_Graph, edited.roots, { 0, 20, 10 });
  const ElementIndex rest = RootTo(m_Graph, edited.roots, { 0, 40, 20 });
  EXPECT_EQ(edited.roots.axes[whole].level, 1);
  EXPECT_EQ(edited.roots.axes[rest].parent, whole);
  EXPECT_DOUBLE_EQ(LengthOf(m_Graph, edited.roots.axes[whole]), 20 + 10);
  EXPECT_DOUBLE_EQ(LengthOf(m_Graph, edited.roots.axes[rest]), 20);
  EXPECT_EQ(edited.now[m_Long], whole);
  EXPECT_EQ(edited.now[m_Small], whole) << "it is part of the other";
}

TEST_F(RootEdits, WhatWasLooseAndGoesOnFromARootIsLooseNoMore)
{
  GraphBuilder builder = SmallRoot();
  builder.Line({ 15, 0, 42 }, { 15, 0, 58 }, 1); // above the middle of a lateral, whose rest then springs from it
  const SkeletonGraph graph = builder.Graph();
  const RootHierarchy roots = FindRoots(graph);
  const auto          piece = std::ranges::find_if(roots.axes, [](const RootAxis & axis) { return axis.loose; });
  ASSERT_NE(piece, roots.axes.end());
  const RootEdit    edit{ static_cast<ElementIndex>(piece - roots.axes.begin()),
                       Kind::Continues,
                       RootTo(graph, roots, { 30, 0, 40 }) };
  const EditedRoots edited = EditRoots(graph, roots, { &edit, 1 });
  ExpectSound(graph, edited.roots);
  EXPECT_EQ(edited.roots.axes.size(), roots.axes.size());
  for (const RootAxis & axis : edited.roots.axes)
  {
    EXPECT_FALSE(axis.loose);
  }
}

TEST_F(RootEdits, TheStemGoesOnElsewhereAndLateralsFollow)
{
  const RootEdit    edit{ m_Side, Kind::Continues, 0 };
  const EditedRoots edited = EditRoots(m_Graph, m_Roots, { &edit, 1 });
  ExpectSound(m_Graph, edited.roots);
  EXPECT_EQ(RootTo(m_Graph, edited.roots, { 30, 0, 40 }), 0U);
  const ElementIndex down = RootTo(m_Graph, edited.roots, { 0, 0, 0 });
  const ElementIndex side = RootTo(m_Graph, edited.roots, { 0, 40, 20 });
  EXPECT_EQ(edited.roots.axes[down].parent, 0U);
  EXPECT_EQ(edited.roots.axes[side].parent, down) << "it springs from what the stem was";
  EXPECT_EQ(m_Graph.positions[edited.roots.axes[down].points[edited.roots.axes[side].parentPoint]],
            (Spacing3{ 0, 0, 20 }));
}

TEST_F(RootEdits, ATornOffPieceIsHungOrGoesOnFromWhicheverEndIsNearer)
{
  GraphBuilder builder = SmallRoot();
  builder.Line({ 60, 0, 40 }, { 34, 0, 40 }, 1.5); // beyond the tip at (30, 0, 40)
  const SkeletonGraph graph = builder.Graph();
  const RootHierarchy roots = FindRoots(graph);
  const auto          loose = std::ranges::find_if(roots.axes, [](const RootAxis & axis) { return axis.loose; });
  ASSERT_NE(loose, roots.axes.end());
  const auto         piece = static_cast<ElementIndex>(loose - roots.axes.begin());
  const ElementIndex side = RootTo(graph, roots, { 30, 0, 40 });
  for (const Kind kind : { Kind::Continues, Kind::Parent })
  {
    const RootEdit    edit{ piece, kind, side };
    const EditedRoots edited = EditRoots(graph, roots, { &edit, 1 });
    ExpectSound(graph, edited.roots);
    const RootAxis & end = edited.roots.axes[RootTo(graph, edited.roots, { 60, 0, 40 })];
    EXPECT_FALSE(end.loose);
    EXPECT_DOUBLE_EQ(LengthOf(graph, end), kind == Kind::Continues ? 60 : 30) << "with the gap";
    EXPECT_EQ(end.level, kind == Kind::Continues ? 1 : 2);
  }
  const RootEdit    stem{ piece, Kind::Stem };
  const EditedRoots edited = EditRoots(graph, roots, { &stem, 1 });
  EXPECT_EQ(MeasureRoots(graph, edited.roots).stems, 2);
}

TEST_F(RootEdits, ATornOffPieceThatIsTurnedRoundKeepsItsLateralsWhereTheyAre)
{
  for (const bool isBeyond : { true, false })
  {
    GraphBuilder builder = SmallRoot();
    // Thick at one end or the other, so that it begins there by itself.
    builder.Line({ 60, 0, 40 }, { 50, 0, 40 }, isBeyond ? 1.5 : 1);
    builder.Line({ 50, 0, 40 }, { 34, 0, 40 }, isBeyond ? 1 : 1.5);
    builder.Line({ 50, 0, 40 }, { 50, 8, 40 }, 0.5);
    const SkeletonGraph graph = builder.Graph();
    const RootHierarchy roots = FindRoots(graph);
    const ElementIndex  small = RootTo(graph, roots, { 50, 8, 40 });
    const ElementIndex  piece = roots.axes[small].parent;
    ASSERT_TRUE(roots.axes[piece].loose);
    for (const Kind kind : { Kind::Continues, Kind::Parent })
    {
      const RootEdit    edit{ piece, kind, RootTo(graph, roots, { 30, 0, 40 }) };
      const EditedRoots edited = EditRoots(graph, roots, { &edit, 1 });
      ExpectSound(graph, edited.roots);
      const RootAxis & lateral = edited.roots.axes[RootTo(graph, edited.roots, { 50, 8, 40 })];
      const RootAxis & parent = edited.roots.axes[lateral.parent];
      EXPECT_EQ(graph.positions[parent.points.back()], (Spacing3{ 60, 0, 40 }));
      EXPECT_EQ(graph.positions[parent.points[lateral.parentPoint]], (Spacing3{ 50, 0, 40 }));
    }
  }
}

TEST_F(RootEdits, NamesStayWithTheirRoots)
{
  const std::vector<RootEdit> edits{ { m_Small, Kind::None, kNoRoot, "the small one" }, { m_Side, Kind::Remove } };
  const EditedRoots           edited = EditRoots(m_Graph, m_Roots, edits);
  EXPECT_EQ(edited.roots.axes[RootTo(m_Graph, edited.roots, { 0, 20, 10 })].name, "the small one");
}

TEST_F(RootEdits, WhatCannotBeIsRefused)
{
  const auto refused = [&](std::vector<RootEdit> edits) {
    EXPECT_THROW(EditRoots(m_Graph, m_Roots, edits), UsageError);
  };
  refused({ { 9, Kind::Remove } });
  refused({ { 1, Kind::Parent, 9 } });
  refused({ { 1, Kind::Parent, 1 } });
  refused({ { m_Long, Kind::Parent, m_Small } });
  refused({ { m_Long, Kind::Continues, m_Small } });
  refused({ { 0, Kind::Continues, m_Small } });
  refused({ { 1, Kind::Continues, 1 } });
  refused({ { 1, Kind::Remove }, { 1, Kind::Stem } });
  refused({ { 0, Kind::Remove } });
}

TEST(RootEdit, IsAWordOrAWordAndANumber)
{
  for (const char * text : { "", "remove", "stem", "parent 12", "continues 0" })
  {
    EXPECT_EQ(RootEditText(ParseRootEdit(text)), text);
  }
  EXPECT_EQ(ParseRootEdit("  parent   3 ").other, 3U);
  for (const char * text : { "removed", "parent", "parent -1", "parent x", "continues 3 4", "parent 4294967296", "3" })
  {
    EXPECT_THROW(ParseRootEdit(text), UsageError) << text;
  }
}

} // namespace
} // namespace voxelcore::testing
