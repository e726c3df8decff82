#include "PartOfCurves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <iostream>
#include <random>
#include <set>
#include <vector>

namespace voxelcore::testing
{

namespace
{

/** Two random trees with vertices on a small grid, where many are equally near to a tip. */
struct TwoTrees
{
  MedialComplex              surface;
  std::vector<std::uint32_t> components;
  LiveElements               live;
  CurveFire                  fire;
};

TwoTrees
RandomTrees(std::mt19937_64 & random)
{
  TwoTrees      trees;
  CellComplex & cells = trees.surface.cells;
  for (const unsigned most : { 30, 9 })
  {
    const auto size = 1 + static_cast<ElementIndex>(random() % most);
    const auto first = static_cast<ElementIndex>(cells.vertexCount);
    for (ElementIndex i = 0; i < size; ++i, ++cells.vertexCount)
    {
      trees.surface.positions.push_back(
        { static_cast<double>(random() % 5), static_cast<double>(random() % 5), static_cast<double>(random() % 3) });
      if (i > 0)
      {
        cells.edges.push_back({ first + static_cast<ElementIndex>(random() % i), first + i });
      }
    }
    // Children before their parents: as fire comes from the ends.
    for (ElementIndex i = size; i-- > 0;)
    {
      trees.fire.order.push_back(first + i);
    }
  }
  trees.components = ComponentOfVertices(cells);
  trees.live.vertices.assign(cells.vertexCount, 1);
  trees.live.edges.assign(cells.edges.size(), 1);
  return trees;
}

/** The vertices that stay, found by looking at every vertex for each tip, then taking loose ends off one by one. */
std::set<ElementIndex>
WaysByDefinition(const std::vector<TipPlace> & tips, const TwoTrees & trees)
{
  std::set<ElementIndex> ends;
  for (const TipPlace & tip : tips)
  {
    ElementIndex nearest = kNoEdge;
    for (ElementIndex vertex = 0; vertex < trees.components.size(); ++vertex)
    {
      if (trees.components[vertex] == tip.component &&
          (nearest == kNoEdge || Distance(trees.surface.positions[vertex], tip.place) <
                                   Distance(trees.surface.positions[nearest], tip.place)))
      {
        nearest = vertex;
      }
    }
    ends.insert(nearest);
  }
  std::set<ElementIndex> left;
  for (ElementIndex vertex = 0; vertex < trees.components.size(); ++vertex)
  {
    left.insert(vertex);
  }
  const auto isLoose = [&](ElementIndex vertex) {
    return ends.count(vertex) == 0 &&
           std::count_if(trees.surface.cells.edges.begin(), trees.surface.cells.edges.end(), [&](const auto & edge) {
             return (edge[0] == vertex || edge[1] == vertex) && left.count(edge[0]) > 0 && left.count(edge[1]) > 0;
           }) == 1;
  };
  for (auto loose = left.begin(); (loose = std::find_if(left.begin(), left.end(), isLoose)) != left.end();)
  {
    left.erase(loose);
  }
  return left;
}

TEST(PartOfCurves, KeepsTheWaysBetweenThePointsNearestToTipsOfEqualsTheFirst)
{
  const auto seed = std::random_device{}();
  std::cout << "seed " << seed << "\n";
  std::mt19937_64 random(seed);
  for (int round = 0; round < 2000; ++round)
  {
    TwoTrees              trees = RandomTrees(random);
    std::vector<TipPlace> tips;
    // At least one a tree: a tree without tips would come down to any one of its vertices.
    for (int k = 0; k < 2 + static_cast<int>(random() % 5); ++k)
    {
      const std::size_t count = trees.components.size();
      const std::size_t of = k == 0 ? 0 : k == 1 ? count - 1 : random() % count;
      tips.push_back(
        { { static_cast<double>(random() % 9) / 2, static_cast<double>(random() % 9) / 2, 1 }, trees.components[of] });
    }
    const auto expected = WaysByDefinition(tips, trees);
    KeepWaysBetween(tips, trees.surface, trees.components, trees.fire, trees.live);
    for (ElementIndex vertex = 0; vertex < trees.components.size(); ++vertex)
    {
      ASSERT_EQ(trees.live.vertices[vertex] != 0, expected.count(vertex) > 0)
        << "vertex " << vertex << ", round " << round << ", seed " << seed;
    }
  }
}

} // namespace

} // namespace voxelcore::testing
