#include "GraphLines.h"
#include "voxelcore/Base/UnionFind.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Skeleton/LoopClosers.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

namespace voxelcore
{

std::optional<BranchPoint>
BranchAt(const SkeletonGraph & graph, const Vector3 & place, double atLeast)
{
  std::optional<BranchPoint> found;
  double                     nearest = std::numeric_limits<double>::infinity();
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    const auto points = graph.Branch(branch);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      const double away = Distance(graph.positions[points[i]], place);
      if (away < nearest && away <= std::max({ SectionRadii(graph)[points[i]], graph.radius[points[i]], atLeast }))
      {
        found = { branch, i };
        nearest = away;
      }
    }
  }
  return found;
}

std::vector<LoopCut>
CutLoops(SkeletonGraph & graph, std::span<const Vector3> real)
{
  std::vector<std::uint8_t> cut = FindLoopClosers(graph, NodeHubs(graph), LeastRadii(graph));
  for (const Vector3 & place : real)
  {
    const auto here = BranchAt(graph, place);
    if (const auto closer = here ? FindCloserOf(graph, here->branch) : std::nullopt)
    {
      cut[*closer] = 0;
    }
  }
  std::vector<LoopCut> cuts;
  GraphLines           lines;
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    std::vector<ElementIndex> line(graph.Branch(branch).begin(), graph.Branch(branch).end());
    if (!cut[branch])
    {
      lines.push_back(std::move(line));
      continue;
    }
    if (graph.nodeKinds[graph.branchNodes[branch][0]] == NodeKind::Loop)
    {
      // Nothing hangs on a closed curve: it may begin at its thinnest point.
      const auto thinnest = std::min_element(line.begin(), line.end() - 1, [&](ElementIndex a, ElementIndex b) {
        return graph.radius[a] < graph.radius[b];
      });
      std::rotate(line.begin(), thinnest, line.end() - 1);
      line.back() = CopyPoint(graph, line.front());
      cuts.push_back({ graph.positions[line.front()], graph.radius[line.front()] });
      lines.push_back(std::move(line));
      continue;
    }
    if (line.size() == 2)
    {
      // No point between its ends: one in their middle.
      const ElementIndex middle = CopyPoint(graph, line[0]);
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        graph.positions[middle][axis] = 0.5 * (graph.positions[line[0]][axis] + graph.positions[line[1]][axis]);
        if (!graph.medial.empty())
        {
          graph.medial[middle][axis] = 0.5 * (graph.medial[line[0]][axis] + graph.medial[line[1]][axis]);
        }
      }
      graph.radius[middle] = 0.5 * (graph.radius[line[0]] + graph.radius[line[1]]);
      if (!graph.sectionRadius.empty())
      {
        graph.sectionRadius[middle] = 0.5 * (graph.sectionRadius[line[0]] + graph.sectionRadius[line[1]]);
      }
      if (!graph.labels.empty())
      {
        graph.labels[middle] = graph.BranchLabel(branch);
        graph.contact[middle] = 0;
      }
      line.insert(line.begin() + 1, middle);
    }
    const auto at = std::min_element(line.begin() + 1, line.end() - 1, [&](ElementIndex a, ElementIndex b) {
      return graph.radius[a] < graph.radius[b];
    });
    std::vector<ElementIndex> rest(at, line.end());
    line.erase(at + 1, line.end());
    rest.front() = CopyPoint(graph, line.back());
    cuts.push_back({ graph.positions[line.back()], graph.radius[line.back()] });
    lines.push_back(std::move(line));
    lines.push_back(std::move(rest));
  }
  SortBranches(graph, lines, false);
  return cuts;
}

std::size_t
PruneMarked(SkeletonGraph & graph, const std::vector<std::uint8_t> & marked)
{
  std::vector<std::vector<std::size_t>> branchesAt(graph.nodePoints.size());
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    for (const ElementIndex node : graph.branchNodes[branch])
    {
      branchesAt[node].push_back(branch);
    }
  }
  const auto isTip = [&](ElementIndex node) {
    const NodeKind kind = graph.nodeKinds[node];
    return branchesAt[node].size() == 1 && (kind == NodeKind::Tip || kind == NodeKind::Junction);
  };
  std::vector<std::uint8_t> isThere(graph.BranchCount(), 1);
  std::vector<std::size_t>  waiting(graph.BranchCount());
  std::iota(waiting.begin(), waiting.end(), std::size_t{ 0 });
  std::size_t count = 0;
  while (!waiting.empty())
  {
    const std::size_t branch = waiting.back();
    waiting.pop_back();
    const auto & nodes = graph.branchNodes[branch];
    if (isThere[branch] == 0 || marked[branch] == 0 || isTip(nodes[0]) == isTip(nodes[1]))
    {
      continue;
    }
    isThere[branch] = 0;
    ++count;
    auto & rest = branchesAt[nodes[isTip(nodes[0]) ? 1 : 0]];
    rest.erase(std::find(rest.begin(), rest.end(), branch));
    waiting.insert(waiting.end(), rest.begin(), rest.end());
  }
  if (count == 0)
  {
    return 0;
  }
  KeepBranches(graph, isThere);
  return count;
}

void
SplitAtJunctions(SkeletonGraph & graph)
{
  GraphLines                lines = LinesOf(graph);
  std::vector<std::uint8_t> used(graph.positions.size(), 0);
  for (auto & line : lines)
  {
    for (ElementIndex * end : { &line.front(), &line.back() })
    {
      if (used[*end])
      {
        *end = CopyPoint(graph, *end);
        used.push_back(1);
      }
      used[*end] = 1;
    }
  }
  SortBranches(graph, lines, false);
}

} // namespace voxelcore
