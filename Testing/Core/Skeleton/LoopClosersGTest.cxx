#include "GraphBuilder.h"

#include "voxelcore/Skeleton/LoopClosers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <numeric>
#include <random>

namespace voxelcore::testing
{
namespace
{

std::vector<ElementIndex>
OwnNodes(const SkeletonGraph & graph)
{
  std::vector<ElementIndex> nodes(graph.nodePoints.size());
  std::iota(nodes.begin(), nodes.end(), 0U);
  return nodes;
}

} // namespace

TEST(LoopClosers, TheThinnestBranchOfALoopClosesIt)
{
  GraphBuilder builder;
  builder.Line({ 0, 0, 0 }, { 30, 0, 0 }, 3);
  builder.Line({ 30, 0, 0 }, { 30, 30, 0 }, 1);
  builder.Line({ 30, 30, 0 }, { 0, 0, 0 }, 2);
  builder.Line({ 30, 30, 0 }, { 60, 60, 0 }, 0.5);
  const SkeletonGraph       graph = builder.Graph();
  const std::vector<double> radii = LeastRadii(graph);
  const auto                closes = FindLoopClosers(graph, OwnNodes(graph), radii);
  for (ElementIndex branch = 0; branch < graph.BranchCount(); ++branch)
  {
    EXPECT_EQ(closes[branch] != 0, graph.radius[graph.Branch(branch)[1]] == 1) << branch;
  }
}

TEST(LoopClosers, NodesThatCountAsOneCloseALoopBetweenThem)
{
  GraphBuilder builder;
  builder.Line({ 0, 0, 0 }, { 30, 0, 0 }, 3);
  const SkeletonGraph graph = builder.Graph();
  EXPECT_EQ(FindLoopClosers(graph, { 0, 1 }, { 3 }), std::vector<std::uint8_t>{ 0 });
  EXPECT_EQ(FindLoopClosers(graph, { 0, 0 }, { 3 }), std::vector<std::uint8_t>{ 1 });
}

// Two triangles over the thinnest side, whose other sides are 4 and 3 thick, and 2.5 and 2.
TEST(LoopClosers, OfTheLoopsThroughABranchTheThickestIsFoundAndIsNotCut)
{
  GraphBuilder builder;
  builder.Line({ 0, 0, 0 }, { 30, 0, 0 }, 4);
  builder.Line({ 0, 0, 0 }, { 0, 30, 0 }, 3);
  builder.Line({ 30, 0, 0 }, { 0, 30, 0 }, 1);
  builder.Line({ 30, 30, 0 }, { 0, 30, 0 }, 2.5); // first, as a node has the radius of its first line
  builder.Line({ 30, 0, 0 }, { 30, 30, 0 }, 2);
  builder.Line({ 30, 30, 0 }, { 60, 60, 0 }, 0.5);
  const SkeletonGraph graph = builder.Graph();
  const auto          radius = [&](std::size_t branch) { return graph.radius[graph.Branch(branch)[1]]; };
  const auto          at = [&](const Vector3 & place) { return BranchAt(graph, place).value().branch; };
  EXPECT_FALSE(FindCloserOf(graph, at({ 50, 50, 0 })));
  EXPECT_EQ(radius(FindCloserOf(graph, at({ 15, 0, 0 })).value()), 2); // all round
  EXPECT_EQ(radius(FindCloserOf(graph, at({ 30, 10, 0 })).value()), 2);
  EXPECT_EQ(radius(FindCloserOf(graph, at({ 15, 15, 0 })).value()), 1);
  EXPECT_FALSE(BranchAt(graph, { 15, 15, 1.5 }));
  EXPECT_TRUE(BranchAt(graph, { 15, 0, 3.9 }));
  for (const auto & [places, cuts] : std::vector<std::pair<std::vector<Vector3>, std::size_t>>{
         { {}, 2 },
         { { { 50, 50, 0 } }, 2 },
         { { { 500, 50, 0 } }, 2 },
         { { { 15, 0, 0 }, { 30, 10, 0 } }, 1 },
         { { { 15, 0, 0 }, { 15, 15, 0 } }, 0 },
       })
  {
    SkeletonGraph cut = graph;
    EXPECT_EQ(CutLoops(cut, places).size(), cuts);
  }
  SkeletonGraph cut = graph;
  EXPECT_EQ(CutLoops(cut, std::vector<Vector3>{ { 15, 15, 0 } }).at(0).radius, 2);
}

// As many as there are loops, and without them no way is wider between any two nodes: here by trying all places.
TEST(LoopClosers, OfARandomNetworkAsManyAsItHasLoopsAndNoneIsThickerThanAWayAroundIt)
{
  const auto seed = std::random_device()();
  std::cout << "seed " << seed << "\n";
  std::mt19937 random(seed);
  for (int run = 0; run < 20; ++run)
  {
    GraphBuilder builder;
    for (int i = 0; i < 12; ++i)
    {
      const int a = static_cast<int>(random() % 6);
      const int b = static_cast<int>((a + 1 + random() % 5) % 6);
      builder.Line({ 40.0 * (a % 2), 40.0 * (a / 2), 7.0 * a * a },
                   { 40.0 * (b % 2), 40.0 * (b / 2), 7.0 * b * b },
                   1 + 0.01 * static_cast<double>(random() % 1000));
    }
    const SkeletonGraph       graph = builder.Graph();
    const std::vector<double> radii = LeastRadii(graph);
    const auto                closes = FindLoopClosers(graph, OwnNodes(graph), radii);
    // The widest way between nodes by what closes no loop: a bottleneck of at least what the closer has.
    const std::size_t                count = graph.nodePoints.size();
    std::vector<std::vector<double>> width(count, std::vector<double>(count, 0));
    std::size_t                      kept = 0;
    for (ElementIndex branch = 0; branch < graph.BranchCount(); ++branch)
    {
      const auto & [a, b] = graph.branchNodes[branch];
      if (closes[branch] == 0)
      {
        ++kept;
        width[a][b] = width[b][a] = std::max(width[a][b], radii[branch]);
      }
    }
    for (std::size_t k = 0; k < count; ++k)
    {
      for (std::size_t i = 0; i < count; ++i)
      {
        for (std::size_t j = 0; j < count; ++j)
        {
          width[i][j] = std::max(width[i][j], std::min(width[i][k], width[k][j]));
        }
      }
    }
    std::size_t pieces = 0;
    for (std::size_t i = 0; i < count; ++i)
    {
      const auto & row = width[i];
      pieces += std::none_of(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(i), [](double w) { return w > 0; });
    }
    EXPECT_EQ(kept, count - pieces);
    for (ElementIndex branch = 0; branch < graph.BranchCount(); ++branch)
    {
      const auto & [a, b] = graph.branchNodes[branch];
      if (closes[branch] != 0 && a != b)
      {
        EXPECT_GE(width[a][b], radii[branch]) << branch;
      }
    }
  }
}

} // namespace voxelcore::testing
