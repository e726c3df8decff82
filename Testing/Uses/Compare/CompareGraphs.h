#pragma once
// Skeletons made of lines, for tests.

#include "voxelcore/Skeleton/SkeletonGraph.h"

#include <vector>

namespace voxelcore::testing
{

/** Lines of points; points at one place are one. */
inline SkeletonGraph
GraphOf(const std::vector<std::vector<Vector3>> & lines, double radius)
{
  SkeletonGraph                          graph;
  std::vector<std::vector<ElementIndex>> numbered;
  for (const auto & line : lines)
  {
    numbered.emplace_back();
    for (const Vector3 & place : line)
    {
      const auto known = std::find(graph.positions.begin(), graph.positions.end(), place);
      numbered.back().push_back(static_cast<ElementIndex>(known - graph.positions.begin()));
      if (known == graph.positions.end())
      {
        graph.positions.push_back(place);
      }
    }
  }
  graph.radius.assign(graph.positions.size(), radius);
  graph.erosionThickness.assign(graph.positions.size(), 0);
  SortBranches(graph, numbered, false);
  return graph;
}

} // namespace voxelcore::testing
