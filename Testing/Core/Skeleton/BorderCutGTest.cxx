#include "GraphBuilder.h"

#include "voxelcore/Skeleton/BorderCut.h"
#include "voxelcore/Skeleton/BranchTable.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace voxelcore::testing
{
namespace
{

/** A grid of 1 x 1 x 2 mm whose lattice corner (0,0,0) is the origin. */
ImageGeometry
Grid()
{
  ImageGeometry geometry;
  geometry.size = { 10, 10, 10 };
  geometry.spacing = { 1, 1, 2 };
  geometry.origin = { 0.5, 0.5, 1 };
  return geometry;
}

constexpr VoxelBox kScan{ { 0, 0, 0 }, { 10, 10, 10 } }; // to 10, 10, 20 mm

std::size_t
Cut(SkeletonGraph & graph, BorderEnds ends = BorderEnds::Open, const std::vector<BorderSection> & sections = {})
{
  return CutAtBorder(graph, VoxelShape(kScan), kScan, Grid(), ends, sections);
}

bool
HasPoint(const SkeletonGraph & graph, const Vector3 & place)
{
  return std::ranges::any_of(graph.positions, [&](const Vector3 & at) { return Distance(at, place) < 1e-9; });
}

TEST(BorderCut, ALineEndsWhereItCrossesTheBorder)
{
  GraphBuilder builder;
  builder.Line({ 5, 5, -6.3 }, { 5, 5, 27 }, 2);
  SkeletonGraph graph = builder.Graph();
  EXPECT_EQ(Cut(graph), 2U);
  ASSERT_EQ(graph.BranchCount(), 1U);
  EXPECT_NEAR(graph.BranchLength(0), 20, 1e-9);
  EXPECT_TRUE(HasPoint(graph, { 5, 5, 0 }));
  EXPECT_TRUE(HasPoint(graph, { 5, 5, 20 }));
}

TEST(BorderCut, WhatIsWithinStaysAsItIs)
{
  GraphBuilder builder;
  builder.Line({ 2, 3, 4 }, { 8, 7, 15 }, 1);
  builder.Line({ 8, 7, 15 }, { 9, 7, 15 }, 1);
  builder.Line({ 8, 7, 15 }, { 8, 9, 15 }, 1);
  SkeletonGraph       graph = builder.Graph();
  const SkeletonGraph before = graph;
  EXPECT_EQ(Cut(graph), 0U);
  EXPECT_EQ(graph.positions, before.positions);
  EXPECT_EQ(graph.branchPoints, before.branchPoints);
}

TEST(BorderCut, AForkOutsideGoesWithItsArmsAndItsStemIsCut)
{
  GraphBuilder builder;
  builder.Line({ 5, 5, 10 }, { 5, 5, 24 }, 2);
  builder.Line({ 5, 5, 24 }, { 2, 5, 28 }, 2);
  builder.Line({ 5, 5, 24 }, { 8, 5, 28 }, 2);
  SkeletonGraph graph = builder.Graph();
  EXPECT_EQ(Cut(graph), 1U);
  ASSERT_EQ(graph.BranchCount(), 1U);
  EXPECT_NEAR(graph.BranchLength(0), 10, 1e-9);
}

TEST(BorderCut, TwoBranchesThatLeaveTogetherStayTogether)
{
  GraphBuilder builder;
  builder.Line({ 2, 5, 10 }, { 5, 5, 23 }, 2);
  builder.Line({ 8, 5, 10 }, { 5, 5, 23 }, 2);
  builder.Line({ 5, 5, 23 }, { 5, 5, 30 }, 2);
  SkeletonGraph graph = builder.Graph();
  Cut(graph);
  const SkeletonNumbers numbers = MeasureBranches(graph).numbers;
  EXPECT_EQ(numbers.components, 1);
  EXPECT_EQ(numbers.tips, 2);
  EXPECT_TRUE(HasPoint(graph, { 5, 5, 20 }));
  for (const Vector3 & at : graph.positions)
  {
    EXPECT_LE(at[2], 20 + 1e-9);
  }
}

TEST(BorderCut, WhatWasAddedObliquelyGoesBackIntoTheSection)
{
  VoxelShape voxels({ { 0, 0, 0 }, { 10, 10, 14 } });
  for (std::int32_t z = 0; z < 14; ++z)
  {
    voxels.Insert(2 + std::max(0, z - 9), 5, z); // leaves the scan to the side
    voxels.Insert(3 + std::max(0, z - 9), 5, z);
  }
  GraphBuilder builder;
  builder.Line({ 2.5, 5.5, 10 }, { 6.5, 5.5, 26 }, 0.5);
  builder.Line({ 3.5, 5.5, 10 }, { 6.5, 5.5, 26 }, 0.5);
  SkeletonGraph graph = builder.Graph();
  CutAtBorder(graph, voxels, kScan, Grid(), BorderEnds::Open, { { 2, true, 2, { 3, 5.5, 9.5 }, 0.5, 1.2, true } });
  EXPECT_TRUE(HasPoint(graph, { 3, 5.5, 19 })) << "in the border's plane the place is none of the body";
  EXPECT_FALSE(HasPoint(graph, { 6.5, 5.5, 20 }));
}

TEST(BorderCut, ALoopBeyondTheBorderStaysOne)
{
  GraphBuilder builder;
  builder.Line({ 5, 5, 10 }, { 5, 5, 24 }, 2);
  builder.Line({ 5, 5, 24 }, { 3, 5, 26 }, 2);
  builder.Line({ 3, 5, 26 }, { 5, 5, 28 }, 2);
  builder.Line({ 5, 5, 28 }, { 5, 5, 24 }, 2);
  SkeletonGraph graph = builder.Graph();
  Cut(graph);
  EXPECT_EQ(MeasureBranches(graph).numbers.cycles, 1);
  EXPECT_EQ(MeasureBranches(graph).numbers.components, 1);
}

TEST(BorderCut, OfAPieceThatIsAllOutsideAPointInTheBorderStays)
{
  GraphBuilder builder;
  builder.Line({ 4, 5, 21 }, { 4, 5, 28 }, 2);
  builder.Line({ 4, 5, 28 }, { 2, 5, 30 }, 2);
  builder.Line({ 4, 5, 28 }, { 6, 5, 30 }, 2);
  SkeletonGraph graph = builder.Graph();
  Cut(graph);
  ASSERT_EQ(graph.nodePoints.size(), 1U);
  EXPECT_EQ(graph.nodeKinds[0], NodeKind::Isolated);
  EXPECT_NEAR(graph.positions[0][2], 20, 1e-9);
}

TEST(BorderCut, OfPartsThatOverlapASectionWithoutAnEndGetsOne)
{
  VoxelShape voxels(kScan);
  for (std::int32_t z = 0; z < 10; ++z)
  {
    voxels.Insert(2, 2, z); // one component, at which the line runs that is farther from the section
    voxels.Insert(8, 8, z);
  }
  GraphBuilder builder;
  builder.Line({ 2.5, 2.5, 2 }, { 2.5, 2.5, 16 }, 0.5);
  builder.Line({ 7.5, 7.5, 2 }, { 7.5, 7.5, 18 }, 0.5);
  SkeletonGraph graph = builder.Graph();
  EXPECT_EQ(CutAtBorder(graph,
                        voxels,
                        kScan,
                        Grid(),
                        BorderEnds::Overlap,
                        { { 2, true, 1, { 2.5, 2.5, 9.5 }, 0.5, 0.7, true } }),
            1U);
  EXPECT_TRUE(HasPoint(graph, { 2.5, 2.5, 19 }));
  ASSERT_EQ(graph.BranchCount(), 2U);
  EXPECT_NEAR(graph.BranchLength(0) + graph.BranchLength(1), 17 + 16, 1e-9);
}

TEST(BorderCut, OfPartsThatOverlapTheEndLiesInTheSectionsCentre)
{
  GraphBuilder builder;
  builder.Line({ 5, 5, 10 }, { 5, 5, 30 }, 2);
  SkeletonGraph graph = builder.Graph();
  BorderSection section{ 2, true, 12, { 4.5, 5.5, 9.5 }, 1, 2, true };
  EXPECT_EQ(Cut(graph, BorderEnds::Overlap, { section }), 1U);
  EXPECT_TRUE(HasPoint(graph, { 4.5, 5.5, 19 }));
  for (const Vector3 & at : graph.positions)
  {
    EXPECT_LE(at[2], 19 + 1e-9);
  }
}

} // namespace
} // namespace voxelcore::testing
