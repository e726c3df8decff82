#include "Core/Skeleton/GraphBuilder.h"

#include "VoxelCoreTesting/Shapes.h"

#include "voxelcore/Roots/RootRoughness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>
#include <vector>

namespace voxelcore::testing
{
namespace
{

constexpr double kStemRadius = 6;
constexpr double kThin = 1.5;

/** A stem along z, ribbed by `ribs` voxels, with two thin laterals, of which one stands out by `shortOne`. */
struct Ribbed
{
  SkeletonGraph graph;
  VoxelShape    shape;
  ImageGeometry geometry;

  Ribbed(double ribs, double shortOne)
  {
    const double tip = 20 + kStemRadius + shortOne - kThin;
    GraphBuilder builder;
    builder.Line({ 20, 20, 100 }, { 20, 20, 70 }, kStemRadius);
    builder.Line({ 20, 20, 70 }, { 20, 20, 40 }, kStemRadius);
    builder.Line({ 20, 20, 40 }, { 20, 20, 4 }, kStemRadius);
    builder.Line({ 20, 20, 70 }, { 56, 20, 70 }, kThin);
    builder.Line({ 20, 20, 40 }, { tip, 20, 40 }, kThin);
    graph = builder.Graph();
    geometry.size = { 64, 40, 104 };
    shape = ShapeWhere({ 64, 40, 104 }, [&](int x, int y, int z) {
      const double own = kStemRadius + (z / 4 % 2 == 0 ? ribs : -ribs);
      const double away = std::hypot(x - 19.5, y - 19.5);
      const auto   inLateral = [&](double height, double end) {
        return x >= 20 && x + 0.5 < end && std::hypot(y - 19.5, z + 0.5 - height) < kThin;
      };
      return (away < own && z > 3 && z < 100) || inLateral(70, 57) || inLateral(40, tip + kThin);
    });
  }
};

TEST(RootRoughness, IsThatOfVoxelsOnASmoothRootAndThatOfItsRibsOnARibbedOne)
{
  for (const double ribs : { 0.0, 2.0 })
  {
    const Ribbed              body(ribs, 30);
    const RootHierarchy       roots = FindRoots(body.graph);
    const std::vector<double> roughness = RootRoughness(body.shape, body.geometry, body.graph, roots);
    const double              ofStem = roughness[roots.axes[0].points[1]];
    // Steps of voxels alone; half of the ribs to each side are all deviations there are.
    EXPECT_GT(ofStem, ribs > 0 ? 1.5 : 0.1) << ribs;
    EXPECT_LT(ofStem, ribs > 0 ? 4.0 : 0.8) << ribs;
    EXPECT_LT(roughness[roots.axes[1].points.back()], 0.7) << "a lateral's is its own";
  }
}

TEST(RootRoughness, WhatStandsOutOfARootNoMoreThanItIsRoughIsLeftOutAndCounted)
{
  for (const auto & [ribs, shortOne, left] : { std::tuple{ 0.0, 4.0, 0U }, { 2.0, 4.0, 1U }, { 2.0, 20.0, 0U } })
  {
    Ribbed           body(ribs, shortOne);
    const RootBulges bulges = LeaveOutBulges(body.shape, body.geometry, RootRules(), body.graph);
    EXPECT_EQ(bulges.count, left) << ribs << " " << shortOne;
    EXPECT_EQ(body.graph.BranchCount(), left > 0 ? 3U : 5U);
    EXPECT_NEAR(bulges.length, left > 0 ? kStemRadius + shortOne - kThin : 0, 1e-9);
    Ribbed    all(ribs, shortOne);
    RootRules keepsAll;
    keepsAll.bulge = 0;
    EXPECT_EQ(LeaveOutBulges(all.shape, all.geometry, keepsAll, all.graph).count, 0U);
  }
}

} // namespace
} // namespace voxelcore::testing
