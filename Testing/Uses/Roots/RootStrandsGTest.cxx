#include "RootStrands.h"

#include "Core/Skeleton/GraphBuilder.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace voxelcore::testing
{
namespace
{

/** Two laterals of a stem that cross at (40, 0, 70), each as thick before as behind. */
SkeletonGraph
CrossingRoots(double radius)
{
  GraphBuilder builder;
  builder.Line({ 0, 0, 120 }, { 0, 0, 100 }, 2 * radius);
  builder.Line({ 0, 0, 100 }, { 0, 0, 40 }, 2 * radius);
  builder.Line({ 0, 0, 40 }, { 0, 0, 0 }, 2 * radius);
  builder.Line({ 0, 0, 100 }, { 40, 0, 70 }, radius);
  builder.Line({ 40, 0, 70 }, { 80, 0, 40 }, radius);
  builder.Line({ 0, 0, 40 }, { 40, 0, 70 }, radius);
  builder.Line({ 40, 0, 70 }, { 80, 0, 100 }, radius);
  return builder.Graph();
}

TEST(RootStrands, StraightRootsGoOnStraightThroughTheirContact)
{
  const SkeletonGraph graph = CrossingRoots(2);
  const RootHierarchy roots = FindRoots(graph);
  ASSERT_EQ(roots.meetings.size(), 1U);
  const auto strands = TraceStrands(graph, roots, roots.meetings[0]);
  ASSERT_EQ(strands.size(), 2U);
  for (const Strand & strand : strands)
  {
    ASSERT_LT(strand.curveFrom, strand.curveTo);
    const Vector3 way = Minus(strand.line.back(), strand.line.front());
    const double  length = Length(way);
    double        before = -1;
    for (const Vector3 & place : strand.line)
    {
      // They give way across, and never go back.
      const double along = Dot(Minus(place, strand.line.front()), way) / length;
      EXPECT_GT(along, before);
      EXPECT_NEAR(Dot(Minus(place, strand.line.front()), { -way[2], 0, way[0] }), 0, 1e-9 * length * length);
      before = along;
    }
    EXPECT_DOUBLE_EQ(before, length);
  }
  // Where they cross they are apart.
  double least = 1e9;
  for (const Vector3 & place : strands[0].line)
  {
    least = std::min(least, SquaredDistance(place, strands[1].line));
  }
  EXPECT_GT(least, 1);
}

TEST(RootStrands, ARootRunThroughTheOtherWayRoundGivesWayTheSame)
{
  GraphBuilder builder;
  builder.Line({ 0, 0, 120 }, { 0, 0, 100 }, 4);
  builder.Line({ 0, 0, 100 }, { 0, 0, 40 }, 4);
  builder.Line({ 0, 0, 40 }, { 0, 0, 0 }, 4);
  builder.Line({ 0, 0, 100 }, { 40, 0, 70 }, 2);
  builder.Line({ 40, 0, 70 }, { 80, 20, 60 }, 2); // both bend where they touch
  builder.Line({ 0, 0, 40 }, { 40, 0, 70 }, 2);
  builder.Line({ 40, 0, 70 }, { 70, -25, 100 }, 2);
  const SkeletonGraph graph = builder.Graph();
  RootHierarchy       roots = FindRoots(graph);
  ASSERT_EQ(roots.meetings.size(), 1U);
  const auto strands = TraceStrands(graph, roots, roots.meetings[0]);
  ASSERT_EQ(strands.size(), 2U);
  std::ranges::reverse(roots.axes[strands[0].axis].points);
  const auto turned = TraceStrands(graph, roots, roots.meetings[0]);
  ASSERT_EQ(turned.size(), 2U);
  ASSERT_LT(strands[0].curveFrom, strands[0].curveTo);
  for (std::size_t which = 0; which < 2; ++which)
  {
    auto line = turned[which].line;
    ASSERT_EQ(line.size(), strands[which].line.size());
    if (which == 0)
    {
      std::ranges::reverse(line);
    }
    for (std::size_t i = 0; i < line.size(); ++i)
    {
      EXPECT_LT(Distance(line[i], strands[which].line[i]), 1e-9) << which << ' ' << i;
    }
  }
}

// Where roots touch, radii are those of parts of a cross section: the strand's is that before and behind.
TEST(RootStrands, ARootIsAsThickAsOutsideTheContact)
{
  SkeletonGraph       graph = CrossingRoots(2);
  const RootHierarchy roots = FindRoots(graph);
  ASSERT_EQ(roots.meetings.size(), 1U);
  for (std::size_t point = 0; point < graph.positions.size(); ++point)
  {
    if (Distance(graph.positions[point], roots.meetings[0].position) <= roots.meetings[0].reach)
    {
      graph.radius[point] = 0.5;
    }
  }
  for (const Strand & strand : TraceStrands(graph, roots, roots.meetings[0]))
  {
    EXPECT_DOUBLE_EQ(strand.radius, 2);
  }
}

} // namespace
} // namespace voxelcore::testing
