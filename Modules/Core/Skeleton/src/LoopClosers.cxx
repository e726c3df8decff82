#include "voxelcore/Skeleton/LoopClosers.h"

#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/UnionFind.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace voxelcore
{

std::vector<double>
LeastRadii(const SkeletonGraph & graph)
{
  std::vector<double> least(graph.BranchCount(), std::numeric_limits<double>::infinity());
  for (std::size_t branch = 0; branch < least.size(); ++branch)
  {
    for (const ElementIndex point : graph.Branch(branch))
    {
      least[branch] = std::min(least[branch], graph.radius[point]);
    }
  }
  return least;
}

std::vector<std::uint8_t>
FindLoopClosers(const SkeletonGraph &             graph,
                const std::vector<ElementIndex> & nodeOf,
                const std::vector<double> &       thickness)
{
  std::vector<ElementIndex> thickFirst(graph.BranchCount());
  std::iota(thickFirst.begin(), thickFirst.end(), 0U);
  ranges::stable_sort(thickFirst, ranges::greater(), [&](ElementIndex branch) { return thickness[branch]; });
  UnionFind                 trees(nodeOf.size());
  std::vector<std::uint8_t> closes(graph.BranchCount(), 0);
  for (const ElementIndex branch : thickFirst)
  {
    const auto & [first, last] = graph.branchNodes[branch];
    if (trees.Find(nodeOf[first]) == trees.Find(nodeOf[last]))
    {
      closes[branch] = 1;
    }
    else
    {
      trees.Unite(nodeOf[first], nodeOf[last]);
    }
  }
  return closes;
}

std::optional<std::size_t>
FindCloserOf(const SkeletonGraph & graph, std::size_t branch)
{
  const std::vector<ElementIndex> hubs = NodeHubs(graph);
  std::vector<double>             thickness = LeastRadii(graph);
  const auto                      before = FindLoopClosers(graph, hubs, thickness);
  if (before[branch] != 0)
  {
    return branch;
  }
  // Put in last, it closes the loop, and what did so before is the thickest way round it.
  thickness[branch] = -1;
  const auto after = FindLoopClosers(graph, hubs, thickness);
  for (std::size_t other = 0; other < before.size(); ++other)
  {
    if (before[other] > after[other])
    {
      return other;
    }
  }
  return std::nullopt;
}

} // namespace voxelcore
