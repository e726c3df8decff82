#include "GraphBuilder.h"

#include "voxelcore/Skeleton/SomaTree.h"

#include <gtest/gtest.h>

#include <cmath>

namespace voxelcore::testing
{

namespace
{

/** Three straight branches from the origin, along x, y and -z, each 20 long and 1 thick, with balls that grow to 6 at
 *  the origin. */
SkeletonGraph
Star()
{
  GraphBuilder builder;
  builder.Line({ 0, 0, 0 }, { 20, 0, 0 }, 1);
  builder.Line({ 0, 0, 0 }, { 0, 20, 0 }, 1);
  builder.Line({ 0, 0, 0 }, { 0, 0, -20 }, 1);
  SkeletonGraph graph = builder.Graph();
  for (std::size_t point = 0; point < graph.radius.size(); ++point)
  {
    graph.radius[point] = std::max(1.0, 6 - Length(graph.positions[point]));
  }
  return graph;
}

} // namespace

TEST(SomaTree, TheSomaIsTheGreatestBallThatHoldsThePlace)
{
  const SkeletonGraph graph = Star();
  EXPECT_EQ(FindSoma(graph, {})->radius, 6);
  EXPECT_EQ(FindSoma(graph, Vector3{ 2, 2, -2 })->centre, (Vector3{ 0, 0, 0 }));
  EXPECT_EQ(FindSoma(graph, Vector3{ 15.2, .5, 0 })->centre, (Vector3{ 15, 0, 0 }));
  EXPECT_EQ(FindSoma(graph, Vector3{ 15, 90, 0 })->centre, (Vector3{ 0, 20, 0 })) << "in no ball: the nearest";
  EXPECT_FALSE(FindSoma(SkeletonGraph(), {}));
}

TEST(SomaTree, BranchesBeginAtTheBallsSurface)
{
  const SomaTree tree = CutAtSoma(Star(), { { 0, 0, 0 }, 5.5 });
  const auto &   graph = tree.graph;
  ASSERT_EQ(graph.BranchCount(), 3U);
  EXPECT_EQ(graph.positions[graph.nodePoints[tree.root]], (Vector3{ 0, 0, 0 }));
  for (std::size_t branch = 0; branch < 3; ++branch)
  {
    EXPECT_NEAR(graph.BranchLength(branch), 20, 1e-12);
    std::size_t atSurface = 0;
    for (const ElementIndex point : graph.Branch(branch))
    {
      const double away = Length(graph.positions[point]);
      EXPECT_TRUE(away == 0 || away >= 5.5 - 1e-12) << away;
      atSurface += std::abs(away - 5.5) < 1e-12 ? 1 : 0;
    }
    EXPECT_EQ(atSurface, 1U);
  }
  EXPECT_EQ(graph.positions.size(), 1U + 3 * 16);
  EXPECT_TRUE(tree.cuts.empty());
}

TEST(SomaTree, LinesThatComeBackAreCutOrLeftOut)
{
  GraphBuilder builder;
  builder.Line({ 0, 0, 0 }, { 20, 0, 0 }, 1);
  // A handle that leaves the ball far, and one that hardly leaves it.
  builder.Line({ 0, 0, 0 }, { 0, 12, 0 }, 1);
  builder.Line({ 0, 12, 0 }, { 0, 12, 4 }, .5);
  builder.Line({ 0, 12, 4 }, { 0, 0, 0 }, 1);
  SkeletonGraph  graph = builder.Graph();
  const SomaTree tree = CutAtSoma(graph, { { 0, 0, 0 }, 5 });
  ASSERT_EQ(tree.cuts.size(), 1U);
  EXPECT_EQ(tree.cuts[0].radius, .5);
  EXPECT_EQ(tree.graph.BranchCount(), 3U);
  const SomaTree larger = CutAtSoma(graph, { { 0, 0, 0 }, 12.5 });
  EXPECT_TRUE(larger.cuts.empty());
  EXPECT_EQ(larger.graph.BranchCount(), 1U);
  const SomaTree whole = CutAtSoma(graph, { { 0, 0, 0 }, 99 });
  EXPECT_EQ(whole.graph.positions.size(), 1U);
  EXPECT_EQ(whole.graph.nodeKinds, (std::vector<NodeKind>{ NodeKind::Isolated }));
}

} // namespace voxelcore::testing
