
#include "voxelcore/SkeletonGraph.h"
#include "voxelcore/UnionFind.h"
#include "voxelcore/Vectors.h"

#include <algorithm>
#include <numeric>
#include <set>

namespace voxelcore
{

namespace
{

using Lines = std::vector<std::vector<ElementIndex>>;

Lines
LinesOf(const SkeletonGraph & graph)
{
  Lines lines;
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    const auto points = graph.Branch(branch);
    lines.emplace_back(points.begin(), points.end());
  }
  return lines;
}

/** Keeps the points with a flag, in their order. */
void
KeepPoints(SkeletonGraph & graph, Lines & lines, const std::vector<std::uint8_t> & keep)
{
  std::vector<ElementIndex> number(keep.size(), 0);
  std::size_t               kept = 0;
  for (std::size_t point = 0; point < keep.size(); ++point)
  {
    if (keep[point])
    {
      number[point] = static_cast<ElementIndex>(kept);
      graph.positions[kept] = graph.positions[point];
      graph.radius[kept] = graph.radius[point];
      graph.erosionThickness[kept] = graph.erosionThickness[point];
      if (!graph.sectionRadius.empty())
      {
        graph.sectionRadius[kept] = graph.sectionRadius[point];
      }
      if (!graph.medial.empty())
      {
        graph.medial[kept] = graph.medial[point];
      }
      ++kept;
    }
  }
  graph.positions.resize(kept);
  graph.radius.resize(kept);
  graph.erosionThickness.resize(kept);
  graph.medial.resize(graph.medial.empty() ? 0 : kept);
  graph.sectionRadius.resize(graph.sectionRadius.empty() ? 0 : kept);
  for (auto & line : lines)
  {
    for (ElementIndex & point : line)
    {
      point = number[point];
    }
  }
  for (ElementIndex & point : graph.faceVertices)
  {
    point = number[point];
  }
}

ElementIndex
CopyPoint(SkeletonGraph & graph, ElementIndex point)
{
  const auto copy = static_cast<ElementIndex>(graph.positions.size());
  graph.positions.push_back(graph.positions[point]);
  graph.radius.push_back(graph.radius[point]);
  graph.erosionThickness.push_back(graph.erosionThickness[point]);
  if (!graph.medial.empty())
  {
    graph.medial.push_back(graph.medial[point]);
  }
  if (!graph.sectionRadius.empty())
  {
    graph.sectionRadius.push_back(graph.sectionRadius[point]);
  }
  return copy;
}

/** One round: branches with a tip for which goes(length, tip, base) holds, nodes given by their points, are looked at
 *  from the shortest on; one that has lost its neighbours waits for the next round. */
template <typename Goes>
std::size_t
PruneOnce(SkeletonGraph & graph, const Goes & goes)
{
  std::vector<std::uint32_t> degree(graph.nodePoints.size(), 0);
  for (const auto & nodes : graph.branchNodes)
  {
    ++degree[nodes[0]];
    ++degree[nodes[1]];
  }
  struct Candidate
  {
    double       length;
    ElementIndex branch;
    ElementIndex base;
  };
  std::vector<Candidate> candidates;
  for (ElementIndex branch = 0; branch < graph.BranchCount(); ++branch)
  {
    const auto & nodes = graph.branchNodes[branch];
    const bool   firstIsTip = graph.nodeKinds[nodes[0]] == NodeKind::Tip;
    const bool   lastIsTip = graph.nodeKinds[nodes[1]] == NodeKind::Tip;
    if (firstIsTip == lastIsTip)
    {
      continue;
    }
    const ElementIndex base = nodes[firstIsTip ? 1 : 0];
    const double       length = graph.BranchLength(branch);
    if (goes(length, graph.nodePoints[nodes[firstIsTip ? 0 : 1]], graph.nodePoints[base]))
    {
      candidates.push_back({ length, branch, base });
    }
  }
  std::sort(candidates.begin(), candidates.end(), [](const Candidate & a, const Candidate & b) {
    return a.length != b.length ? a.length < b.length : a.branch < b.branch;
  });
  std::vector<std::uint8_t> gone(graph.BranchCount(), 0);
  std::size_t               count = 0;
  for (const Candidate & candidate : candidates)
  {
    const bool isSurface = graph.nodeKinds[candidate.base] == NodeKind::Surface;
    if (isSurface || degree[candidate.base] >= 3)
    {
      --degree[candidate.base];
      gone[candidate.branch] = 1;
      ++count;
    }
  }
  if (count == 0)
  {
    return 0;
  }
  std::vector<std::uint8_t> keep(graph.positions.size(), 1);
  for (const bool flag : { false, true })
  {
    for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
    {
      for (const ElementIndex point : graph.Branch(branch))
      {
        keep[point] = static_cast<std::uint8_t>(flag && (keep[point] || !gone[branch]));
      }
    }
  }
  for (std::size_t node = 0; node < graph.nodePoints.size(); ++node)
  {
    if (graph.nodeKinds[node] == NodeKind::Isolated)
    {
      keep[graph.nodePoints[node]] = 1;
    }
  }
  for (const ElementIndex point : graph.faceVertices)
  {
    keep[point] = 1;
  }
  Lines lines;
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    if (!gone[branch])
    {
      const auto points = graph.Branch(branch);
      lines.emplace_back(points.begin(), points.end());
    }
  }
  KeepPoints(graph, lines, keep);
  SortBranches(graph, lines, true);
  return count;
}

/** Rounds until none goes; gives the number of branches that went. */
template <typename Goes>
std::size_t
PruneWhere(SkeletonGraph & graph, const Goes & goes)
{
  std::size_t all = 0;
  for (std::size_t count = PruneOnce(graph, goes); count > 0; count = PruneOnce(graph, goes))
  {
    all += count;
  }
  return all;
}

} // namespace

std::size_t
PruneBranches(SkeletonGraph & graph, const BranchLimit & limit)
{
  return PruneWhere(graph, [&](double length, ElementIndex, ElementIndex base) {
    return length < limit.lengthMm || length < limit.radiusRatio * graph.radius[base];
  });
}

std::size_t
PruneCutEnds(SkeletonGraph & graph, const std::vector<LoopCut> & cuts, double standOut)
{
  std::set<Vector3> places;
  for (const LoopCut & cut : cuts)
  {
    places.insert(cut.position);
  }
  return PruneWhere(graph, [&](double length, ElementIndex tip, ElementIndex base) {
    return length + graph.radius[tip] - graph.radius[base] < standOut && places.count(graph.positions[tip]) > 0;
  });
}

std::vector<LoopCut>
CutLoops(SkeletonGraph & graph)
{
  const std::vector<ElementIndex> hubs = NodeHubs(graph);
  std::vector<ElementIndex>       thickFirst(graph.BranchCount());
  std::vector<double>             thickness(graph.BranchCount());
  std::iota(thickFirst.begin(), thickFirst.end(), 0U);
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    double least = graph.radius[graph.Branch(branch).front()];
    for (const ElementIndex point : graph.Branch(branch))
    {
      least = std::min(least, graph.radius[point]);
    }
    thickness[branch] = least;
  }
  std::stable_sort(thickFirst.begin(), thickFirst.end(), [&](ElementIndex a, ElementIndex b) {
    return thickness[a] > thickness[b];
  });
  UnionFind                 trees(hubs.size());
  std::vector<std::uint8_t> cut(graph.BranchCount(), 0);
  for (const ElementIndex branch : thickFirst)
  {
    const auto & nodes = graph.branchNodes[branch];
    if (trees.Find(hubs[nodes[0]]) == trees.Find(hubs[nodes[1]]))
    {
      cut[branch] = 1;
    }
    else
    {
      trees.Unite(hubs[nodes[0]], hubs[nodes[1]]);
    }
  }
  std::vector<LoopCut> cuts;
  Lines                lines;
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

void
SplitAtJunctions(SkeletonGraph & graph)
{
  Lines                     lines = LinesOf(graph);
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
