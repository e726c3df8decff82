#include "Core/Skeleton/GraphBuilder.h"

#include "voxelcore/Roots/RootTraits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

namespace voxelcore::testing
{

TEST(RootTraits, NumbersOfASmallRootAreThoseOfItsLines)
{
  const SkeletonGraph graph = SmallRoot().Graph();
  const RootHierarchy roots = FindRoots(graph);
  const RootTraits    traits = MeasureRoots(graph, roots, 30);
  ASSERT_EQ(traits.roots.size(), 4U);
  EXPECT_EQ(traits.stems, 1);
  EXPECT_NEAR(traits.stemLength, 60, 1e-9);
  EXPECT_NEAR(traits.stemDiameter, (6 * 40 + 4 * 20) / 60.0, 0.2); // radii change at a point
  EXPECT_NEAR(traits.depth, 60, 1e-9);
  EXPECT_NEAR(traits.width, 50, 0.05); // from (30, 0) to (0, 40)
  ASSERT_EQ(traits.levels.size(), 5U);
  EXPECT_EQ(traits.levels[1].count, 2);
  // Laterals begin at the first point outside the stem's radius, of 3 and of 3 or 2.
  EXPECT_NEAR(traits.levels[1].totalLength, 27 + 37, 1.1);
  EXPECT_NEAR(traits.levels[1].meanEmergenceAngle, 90, 1e-6);
  EXPECT_NEAR(traits.levels[1].meanTipFromDown, 90, 1e-6);
  EXPECT_NEAR(traits.levels[2].meanTipFromDown, 0, 1e-6);
  EXPECT_NEAR(traits.levels[2].meanTipAngle, 90, 1e-6);
  EXPECT_NEAR(traits.levels[0].meanChildren, 2, 1e-12);
  EXPECT_EQ(traits.levels[3].kind, RootLevelRecord::Kind::Laterals);
  EXPECT_EQ(traits.levels[3].count, 3);
  EXPECT_EQ(traits.levels[4].count, 4);
  EXPECT_NEAR(traits.levels[4].totalLength, traits.levels[3].totalLength + 60, 1e-9);
  EXPECT_EQ(traits.rootsAboveSoil, 1);
  EXPECT_EQ(traits.rootsBelowSoil, 2);
  double byDepth = 0;
  double byDiameter = 0;
  for (std::size_t i = 0; i < traits.depths.size(); ++i)
  {
    byDepth += traits.depths[i].length;
    byDiameter += traits.diameters[i].length;
  }
  EXPECT_NEAR(byDepth, traits.levels[4].totalLength, 1e-9);
  EXPECT_NEAR(byDiameter, traits.levels[4].totalLength, 1e-9);
  for (std::size_t axis = 1; axis < roots.axes.size(); ++axis)
  {
    EXPECT_NEAR(traits.roots[axis].tortuosity, 1, 1e-12);
    EXPECT_NEAR(traits.roots[axis].chord, traits.roots[axis].length, 1e-9);
  }
}

// Each millimetre of a skeleton is on a root, or it is said why not.
TEST(RootTraits, TheLengthOfASkeletonIsThatOfItsRootsAndOfWhatIsLeftOut)
{
  GraphBuilder builder;
  builder.Line({ 0, 0, 120 }, { 0, 0, 100 }, 4);
  builder.Line({ 0, 0, 100 }, { 0, 0, 80 }, 4);
  builder.Line({ 0, 0, 80 }, { 0, 0, 0 }, 4);
  builder.Line({ 0, 0, 100 }, { 30, 0, 71 }, 1); // two roots side by side, with a bridge
  builder.Line({ 30, 0, 71 }, { 60, 0, 41 }, 1);
  builder.Line({ 0, 0, 80 }, { 30, 0, 69 }, 1);
  builder.Line({ 30, 0, 69 }, { 60, 0, 58 }, 1);
  builder.Line({ 30, 0, 71 }, { 30, 0, 69 }, 1);
  const SkeletonGraph graph = builder.Graph();
  double              length = 0;
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    length += graph.BranchLength(branch);
  }
  RootRules rules;
  rules.up = Vector3{ 0, 0, 1 };
  RootHierarchy roots = FindRoots(graph, rules);
  ASSERT_EQ(roots.axes.size(), 3U);
  const RootBalance balance = MeasureRoots(graph, roots, std::nullopt).balance;
  EXPECT_NEAR(balance.skeleton, length, 1e-9);
  EXPECT_NEAR(balance.bridges, 2, 1e-9);
  EXPECT_NEAR(balance.Missing(), 0, 1e-9);
  EXPECT_GT(balance.within, 6); // of two laterals, from the stem's axis to its surface
  roots.leftOut.assign(graph.BranchCount(), LeftOut::No);
  EXPECT_NEAR(MeasureRoots(graph, roots, std::nullopt).balance.Missing(), 2, 1e-9);
}

TEST(RootTraits, ASlantingRootHasItsAngles)
{
  GraphBuilder builder;
  builder.Line({ 0, 0, 100 }, { 0, 0, 60 }, 3);
  builder.Line({ 0, 0, 60 }, { 0, 0, 0 }, 3);
  builder.Line({ 0, 0, 60 }, { 30, 40, 10 }, 1); // 45 degrees
  const SkeletonGraph graph = builder.Graph();
  const RootTraits    traits = MeasureRoots(graph, FindRoots(graph));
  ASSERT_EQ(traits.roots.size(), 2U);
  EXPECT_NEAR(traits.roots[1].emergenceAngle, 45, 1e-6);
  EXPECT_NEAR(traits.roots[1].tipFromDown, 45, 1e-6);
  EXPECT_NEAR(traits.roots[1].alongParent, 40, 1e-9);
  EXPECT_NEAR(traits.roots[1].tipDepth, 90, 1e-9);
  EXPECT_TRUE(std::isnan(traits.roots[0].emergenceAngle));
  EXPECT_FALSE(traits.soilDepth);
}

TEST(RootTraits, TheHullOfACubesCornersIsTheCube)
{
  GraphBuilder builder;
  for (const double y : { 0.0, 10.0 })
  {
    for (const double z : { 0.0, 10.0 })
    {
      builder.Line({ 0, y, z }, { 10, y, z }, 1);
    }
  }
  const SkeletonGraph graph = builder.Graph();
  const RootTraits    traits = MeasureRoots(graph, FindRoots(graph));
  EXPECT_NEAR(traits.hullVolume, 1000, 1e-6);
  EXPECT_NEAR(traits.hullSurface, 600, 1e-6);
  EXPECT_NEAR(traits.width, 10 * std::sqrt(2.0), 0.01);
}

TEST(RootTraits, TheHullOfManyPointsInFewPlanesIsTheirBox)
{
  GraphBuilder builder;
  for (int y = 0; y <= 40; ++y)
  {
    for (int z = 0; z <= 40; z += y % 2 == 0 ? 1 : 40)
    {
      builder.Line({ 0, static_cast<double>(y), static_cast<double>(z) },
                   { 40, static_cast<double>(y), static_cast<double>(z) },
                   1);
    }
  }
  const SkeletonGraph graph = builder.Graph();
  const RootTraits    traits = MeasureRoots(graph, FindRoots(graph));
  EXPECT_NEAR(traits.hullVolume, 64000, 0.1);
  EXPECT_NEAR(traits.hullSurface, 9600, 0.1);
}

TEST(RootTraits, VolumeAndSurfaceAreThoseOfRoundCones)
{
  GraphBuilder builder;
  builder.Line({ 0, 0, 50 }, { 0, 0, 0 }, 2);
  const SkeletonGraph graph = builder.Graph();
  const RootTraits    traits = MeasureRoots(graph, FindRoots(graph));
  EXPECT_NEAR(traits.levels.back().volume, M_PI * 4 * 50, 1e-6);
  EXPECT_NEAR(traits.levels.back().surface, M_PI * 4 * 50, 1e-6);
  EXPECT_EQ(traits.roots[0].minDiameter, 4);
}

TEST(RootTraits, ATaperingRootIsOneCone)
{
  GraphBuilder builder;
  builder.Line({ 0, 0, 50 }, { 0, 0, 0 }, 2);
  SkeletonGraph graph = builder.Graph();
  for (std::size_t point = 0; point < graph.positions.size(); ++point)
  {
    graph.radius[point] = 1 + graph.positions[point][2] / 25;
  }
  const RootTraits traits = MeasureRoots(graph, FindRoots(graph));
  EXPECT_NEAR(traits.roots[0].volume, M_PI * 50 / 3 * (1 + 3 + 9), 1e-6);
  EXPECT_NEAR(traits.roots[0].surface, M_PI * (1 + 3) * std::hypot(50, 2), 1e-6);
  EXPECT_NEAR(traits.roots[0].meanDiameter, 4, 1e-9);
  EXPECT_EQ(traits.roots[0].minDiameter, 2);
  EXPECT_EQ(traits.roots[0].maxDiameter, 6);
}

TEST(RootTraits, ASectionThatIsTooSmallForTheBallIsWidened)
{
  SkeletonGraph graph;
  for (int i = 0; i < 100; ++i)
  {
    graph.positions.push_back({ 0, 0, 1.0 * i });
    graph.radius.push_back(5.3);
    graph.sectionRadius.push_back(i < 30 ? 3 : i < 40 ? 6 : 5); // shared out wrongly, beside a lateral, as it is
  }
  WidenToBalls(graph);
  for (std::size_t i = 0; i < 100; ++i)
  {
    EXPECT_DOUBLE_EQ(graph.sectionRadius[i], i >= 30 && i < 40 ? 6 : 5) << i;
  }
  // Sections greater than balls say nothing of balls.
  graph.radius.assign(100, 4);
  const std::vector<double> before = graph.sectionRadius;
  WidenToBalls(graph);
  EXPECT_EQ(graph.sectionRadius, before);
  graph.sectionRadius.clear();
  WidenToBalls(graph);
  EXPECT_TRUE(graph.sectionRadius.empty());
}

} // namespace voxelcore::testing
