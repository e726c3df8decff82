#include "voxelcore/Skeleton/SoundSkeleton.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

namespace voxelcore::testing
{
namespace
{

/** Two lines that meet, and a face at the end of one. */
SkeletonGraph
Small()
{
  SkeletonGraph graph;
  graph.positions = { { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 }, { 3, 1, 0 }, { 3, -1, 0 }, { 4, 0, 0 } };
  graph.radius.assign(6, 1);
  graph.erosionThickness.assign(6, std::numeric_limits<double>::infinity());
  graph.faceVertices = { 3, 4, 5 };
  graph.faceOffsets = { 0, 3 };
  graph.closedFace = { 0 };
  SortBranches(graph, { { 0, 1, 2 }, { 2, 3 } }, false);
  return graph;
}

TEST(SoundSkeleton, IsOneWhoseArraysAgree)
{
  EXPECT_TRUE(IsSkeleton(Small()));
  EXPECT_TRUE(IsSkeleton(SkeletonGraph()));
  SkeletonGraph more = Small();
  more.medial = more.positions;
  more.sectionRadius = more.radius;
  EXPECT_TRUE(IsSkeleton(more));
}

TEST(SoundSkeleton, IsNoneWhoseNumbersOrIndicesCannotBe)
{
  const auto expect = [](const char * what, const std::function<void(SkeletonGraph &)> & change) {
    SkeletonGraph graph = Small();
    change(graph);
    EXPECT_FALSE(IsSkeleton(graph)) << what;
  };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  ASSERT_GE(Small().BranchCount(), 1U);
  expect("a radius less", [](SkeletonGraph & g) { g.radius.pop_back(); });
  expect("a radius below 0", [](SkeletonGraph & g) { g.radius[2] = -1; });
  expect("a radius that is no number", [](SkeletonGraph & g) { g.radius[2] = nan; });
  expect("a place that is none", [](SkeletonGraph & g) { g.positions[1][2] = nan; });
  expect("a thickness less", [](SkeletonGraph & g) { g.erosionThickness.pop_back(); });
  expect("a thickness that is no number", [](SkeletonGraph & g) { g.erosionThickness[0] = nan; });
  expect("places for some", [](SkeletonGraph & g) { g.medial.resize(2); });
  expect("sections for some", [](SkeletonGraph & g) { g.sectionRadius.resize(2); });
  expect("a node that is not there", [](SkeletonGraph & g) { g.nodePoints[0] = 6; });
  expect("a kind less", [](SkeletonGraph & g) { g.nodeKinds.pop_back(); });
  expect("a kind that is none", [](SkeletonGraph & g) { g.nodeKinds[0] = static_cast<NodeKind>(9); });
  expect("a point that is not there", [](SkeletonGraph & g) { g.branchPoints[1] = 6; });
  expect("an end that is no node", [](SkeletonGraph & g) { g.branchNodes[0][1] = 99; });
  expect("an end of another node", [](SkeletonGraph & g) { std::swap(g.branchNodes[0][0], g.branchNodes[0][1]); });
  expect("offsets that fall", [](SkeletonGraph & g) { g.branchOffsets.back() = 1; });
  expect("no offsets", [](SkeletonGraph & g) { g.branchOffsets.clear(); });
  expect("no offsets of faces", [](SkeletonGraph & g) { g.faceOffsets.clear(); });
  expect("a corner that is not there", [](SkeletonGraph & g) { g.faceVertices[0] = 6; });
  expect("a face less", [](SkeletonGraph & g) { g.closedFace.clear(); });
  expect("a face neither closed nor open", [](SkeletonGraph & g) { g.closedFace[0] = 2; });
}

} // namespace
} // namespace voxelcore::testing
