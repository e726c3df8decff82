#include "voxelcore/Skeleton/DomeBranches.h"

#include "TubeShapes.h"

#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Shape/LabelContacts.h"

#include <gtest/gtest.h>

namespace voxelcore::testing
{
namespace
{

const Spacing3 kSides{ 70, 60, 40 };

VoxelShape
TubeAnd(const Spacing3 & centre, double radius)
{
  const Curve axis = SampleCurve([](double t) { return Spacing3{ 5 + 60 * t, 20, 20 }; }, 200);
  return UnionOfLabels({ { 1, "tube", 0, Tube(axis, 4, kSides) }, { 2, "ball", 0, Tube({ centre }, radius, kSides) } });
}

/** A line through places, a point every mm but on the way to place `bare`, with the radii of balls in a shape. */
SkeletonGraph
LineThrough(const Curve & places, const OpenShape & inside, std::size_t bare = 0)
{
  SkeletonGraph             graph;
  std::vector<ElementIndex> line;
  for (std::size_t i = 1; i < places.size(); ++i)
  {
    const auto steps = i == bare ? 1 : static_cast<int>(Distance(places[i - 1], places[i]));
    for (int k = i == 1 ? 0 : 1; k <= steps; ++k)
    {
      line.push_back(static_cast<ElementIndex>(graph.positions.size()));
      graph.positions.push_back(
        AddScaled(places[i - 1], static_cast<double>(k) / steps, Minus(places[i], places[i - 1])));
      graph.radius.push_back(inside.DistanceToBoundary(graph.positions.back(), 0, 40));
      graph.erosionThickness.push_back(0);
    }
  }
  SortBranches(graph, { line }, false);
  return graph;
}

TEST(DomeBranches, AWayIntoADomeAndBackBecomesOneBranch)
{
  const Spacing3      centre{ 35, 31.5, 20 };
  const VoxelShape    shape = TubeAnd(centre, 9);
  const ImageGeometry geometry = GridFromOrigin({ 1, 1, 1 });
  const OpenShape     inside(shape, geometry);
  SkeletonGraph graph = LineThrough({ { 8, 20, 20 }, { 29, 20, 20 }, centre, { 41, 20, 20 }, { 62, 20, 20 } }, inside);
  ASSERT_EQ(BranchIntoDomes(graph, inside, 2), 1U);
  EXPECT_EQ(graph.BranchCount(), 3U);
  std::size_t tips = 0;
  for (std::size_t node = 0; node < graph.nodeKinds.size(); ++node)
  {
    const Vector3 & place = graph.positions[graph.nodePoints[node]];
    if (graph.nodeKinds[node] == NodeKind::Tip)
    {
      ++tips;
      EXPECT_LT(std::min({ Distance(place, centre), Distance(place, { 8, 20, 20 }), Distance(place, { 62, 20, 20 }) }),
                1);
    }
    else
    {
      EXPECT_NEAR(place[0], 35, 0.5);
      EXPECT_LT(place[1], 29) << "nearer to the tube than the dome's centre";
    }
  }
  EXPECT_EQ(tips, 3U);
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    const auto points = graph.Branch(branch);
    for (std::size_t i = 1; i < points.size(); ++i)
    {
      EXPECT_TRUE(inside.HoldsSegment(graph.positions[points[i - 1]], graph.positions[points[i]]));
    }
  }
}

TEST(DomeBranches, AWayBackWithoutPointsIsFoundToo)
{
  const Spacing3   centre{ 35, 31.5, 20 };
  const VoxelShape shape = TubeAnd(centre, 9);
  const auto       geometry = GridFromOrigin({ 1, 1, 1 });
  const OpenShape  inside(shape, geometry);
  for (const std::size_t bare : { 2U, 3U })
  {
    SkeletonGraph graph =
      LineThrough({ { 8, 20, 20 }, { 33, 20, 20 }, centre, { 37, 20, 20 }, { 62, 20, 20 } }, inside, bare);
    EXPECT_EQ(BranchIntoDomes(graph, inside, 2), 1U) << bare;
    EXPECT_EQ(graph.BranchCount(), 3U) << bare;
  }
}

/** How far points of branches between 8 and 62 along the tube lie off its axis, but for those nearer to the dome. */
double
FarthestOffAxis(const SkeletonGraph & graph)
{
  double farthest = 0;
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    const auto points = graph.Branch(branch);
    const auto along = [&](ElementIndex point) { return std::abs(graph.positions[point][0] - 35); };
    if (std::max(along(points.front()), along(points.back())) > 10)
    {
      for (const ElementIndex point : points)
      {
        farthest = std::max(farthest, std::hypot(graph.positions[point][1] - 20, graph.positions[point][2] - 20));
      }
    }
  }
  return farthest;
}

TEST(DomeBranches, TheLineOfTheTubeGoesStraightOnPastADome)
{
  const Spacing3      centre{ 35, 31.5, 20 };
  const VoxelShape    shape = TubeAnd(centre, 9);
  const ImageGeometry geometry = GridFromOrigin({ 1, 1, 1 });
  const OpenShape     inside(shape, geometry);
  SkeletonGraph graph = LineThrough({ { 8, 20, 20 }, { 29, 20, 20 }, centre, { 41, 20, 20 }, { 62, 20, 20 } }, inside);
  ASSERT_EQ(BranchIntoDomes(graph, inside, 2), 1U);
  EXPECT_GT(FarthestOffAxis(graph), 3);
  ASSERT_EQ(StraightenPastDomes(graph, inside), 1U);
  EXPECT_LT(FarthestOffAxis(graph), 0.1);
  EXPECT_EQ(graph.BranchCount(), 3U);
  for (std::size_t point = 0; point < graph.positions.size(); ++point)
  {
    EXPECT_NEAR(graph.radius[point], inside.DistanceToBoundary(graph.positions[point], 0, 40), 1e-9);
  }
}

TEST(DomeBranches, ALineThatEndsBesideItsDomeOrHasNoneStays)
{
  const Spacing3      centre{ 35, 31.5, 20 };
  const VoxelShape    shape = TubeAnd(centre, 9);
  const ImageGeometry geometry = GridFromOrigin({ 1, 1, 1 });
  const OpenShape     inside(shape, geometry);
  SkeletonGraph       ends = LineThrough({ { 8, 20, 20 }, { 29, 20, 20 }, centre, { 41, 20, 20 } }, inside);
  ASSERT_EQ(BranchIntoDomes(ends, inside, 2), 1U);
  EXPECT_EQ(StraightenPastDomes(ends, inside), 0U);
  SkeletonGraph none = LineThrough({ { 8, 20, 20 }, { 62, 20, 20 } }, inside);
  EXPECT_EQ(StraightenPastDomes(none, inside), 0U);
}

TEST(DomeBranches, ABallOnTheAxisOrAShallowOneIsNoDome)
{
  const ImageGeometry geometry = GridFromOrigin({ 1, 1, 1 });
  for (const double across : { 20.0, 22.0 })
  {
    const VoxelShape shape = TubeAnd({ 35, across, 20 }, 9);
    const OpenShape  inside(shape, geometry);
    SkeletonGraph    graph =
      LineThrough({ { 8, 20, 20 }, { 29, 20, 20 }, { 35, across, 20 }, { 41, 20, 20 }, { 62, 20, 20 } }, inside);
    EXPECT_EQ(BranchIntoDomes(graph, inside, 2), 0U) << across;
    EXPECT_EQ(graph.BranchCount(), 1U);
  }
}

TEST(DomeBranches, WhatStandsOutByLessIsNoDome)
{
  const Spacing3      centre{ 35, 31.5, 20 };
  const VoxelShape    shape = TubeAnd(centre, 9);
  const ImageGeometry geometry = GridFromOrigin({ 1, 1, 1 });
  const OpenShape     inside(shape, geometry);
  SkeletonGraph graph = LineThrough({ { 8, 20, 20 }, { 29, 20, 20 }, centre, { 41, 20, 20 }, { 62, 20, 20 } }, inside);
  EXPECT_EQ(BranchIntoDomes(graph, inside, 20), 0U);
}

} // namespace
} // namespace voxelcore::testing
