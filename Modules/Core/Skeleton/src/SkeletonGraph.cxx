#include "voxelcore/Skeleton/SkeletonGraph.h"


#include "voxelcore/Base/UnionFind.h"
#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace voxelcore
{

namespace
{

constexpr ElementIndex kNone = 0xFFFFFFFFU;

/** Lines as parts of longer lines: which lines end in each point. */
struct LineEnds
{
  LineEnds(std::size_t points, const std::vector<std::vector<ElementIndex>> & lines)
    : count(points, 0)
    , offsets(points + 1, 0)
  {
    for (const auto & line : lines)
    {
      ++count[line.front()];
      ++count[line.back()];
    }
    for (std::size_t point = 0; point < points; ++point)
    {
      offsets[point + 1] = offsets[point] + count[point];
    }
    ends.resize(offsets[points]);
    std::vector<std::uint64_t> next(offsets.begin(), offsets.end() - 1);
    for (std::size_t line = 0; line < lines.size(); ++line)
    {
      ends[next[lines[line].front()]++] = static_cast<std::uint32_t>(2 * line);
      ends[next[lines[line].back()]++] = static_cast<std::uint32_t>(2 * line + 1);
    }
  }

  std::vector<std::uint32_t> count;
  std::vector<std::uint64_t> offsets;
  std::vector<std::uint32_t> ends; ///< twice the line, plus 1 for its last point
};

/** Follows lines from one end through points where just two end, appending points; marks the lines taken. */
std::vector<ElementIndex>
FollowLine(std::uint32_t                                  end,
           const std::vector<std::vector<ElementIndex>> & lines,
           const LineEnds &                               ends,
           const std::vector<std::uint8_t> &              stop,
           std::vector<std::uint8_t> &                    taken)
{
  std::vector<ElementIndex> path;
  for (;;)
  {
    const auto & line = lines[end / 2];
    taken[end / 2] = 1;
    const std::size_t skip = path.empty() ? 0 : 1;
    if (end % 2 == 0)
    {
      path.insert(path.end(), line.begin() + static_cast<std::ptrdiff_t>(skip), line.end());
    }
    else
    {
      path.insert(path.end(), line.rbegin() + static_cast<std::ptrdiff_t>(skip), line.rend());
    }
    const ElementIndex at = path.back();
    if (stop[at])
    {
      return path;
    }
    const std::uint32_t first = ends.ends[ends.offsets[at]];
    const std::uint32_t other = first == (end ^ 1U) ? ends.ends[ends.offsets[at] + 1] : first;
    if (taken[other / 2])
    {
      return path; // once around
    }
    end = other;
  }
}

void
AddBranches(SkeletonGraph &                        graph,
            std::vector<std::vector<ElementIndex>> branches,
            const std::vector<ElementIndex> &      nodeOf)
{
  for (auto & branch : branches)
  {
    const auto forward = std::pair(branch.front(), branch[1]);
    const auto backward = std::pair(branch.back(), branch[branch.size() - 2]);
    if (backward < forward)
    {
      std::reverse(branch.begin(), branch.end());
    }
  }
  std::sort(branches.begin(), branches.end(), [](const auto & a, const auto & b) {
    return std::tuple(a.front(), a[1], a.back()) < std::tuple(b.front(), b[1], b.back());
  });
  graph.branchOffsets.assign(1, 0);
  graph.branchPoints.clear();
  graph.branchNodes.clear();
  for (const auto & branch : branches)
  {
    graph.branchPoints.insert(graph.branchPoints.end(), branch.begin(), branch.end());
    graph.branchOffsets.push_back(graph.branchPoints.size());
    graph.branchNodes.push_back({ nodeOf[branch.front()], nodeOf[branch.back()] });
  }
}

} // namespace

std::vector<std::uint8_t>
TipFlags(const SkeletonGraph & graph)
{
  std::vector<std::uint8_t> isTip(graph.positions.size(), 0);
  for (std::size_t node = 0; node < graph.nodePoints.size(); ++node)
  {
    isTip[graph.nodePoints[node]] = graph.nodeKinds[node] == NodeKind::Tip ? 1 : 0;
  }
  return isTip;
}

double
SkeletonGraph::BranchLength(std::size_t branch) const
{
  const auto points = Branch(branch);
  double     length = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
  {
    length += Distance(positions[points[i - 1]], positions[points[i]]);
  }
  return length;
}

std::int64_t
SkeletonGraph::BranchLabel(std::size_t branch) const
{
  const auto points = Branch(branch);
  const auto own = std::find_if(points.begin(), points.end(), [&](ElementIndex point) { return !contact[point]; });
  return labels[own == points.end() ? points.front() : *own];
}

void
SortBranches(SkeletonGraph & graph, const std::vector<std::vector<ElementIndex>> & lines, bool join)
{
  const std::size_t         count = graph.positions.size();
  const LineEnds            ends(count, lines);
  std::vector<std::uint8_t> onFace(count, 0);
  for (const ElementIndex point : graph.faceVertices)
  {
    onFace[point] = 1;
  }
  std::vector<std::uint8_t> onLine(count, 0);
  for (const auto & line : lines)
  {
    for (const ElementIndex point : line)
    {
      onLine[point] = 1;
    }
  }
  const auto isContact = [&](std::size_t point) { return !graph.contact.empty() && graph.contact[point] != 0; };
  std::vector<std::uint8_t> stop(count, 0);
  for (std::size_t point = 0; point < count; ++point)
  {
    stop[point] = ends.count[point] != 0 && (ends.count[point] != 2 || onFace[point] || !join || isContact(point));
  }
  std::vector<std::vector<ElementIndex>> branches;
  std::vector<std::uint8_t>              taken(lines.size(), 0);
  std::vector<std::uint8_t>              loopStart(count, 0);
  for (const bool isLoops : { false, true })
  {
    for (std::size_t point = 0; point < count; ++point)
    {
      if (!isLoops && !stop[point])
      {
        continue;
      }
      for (std::uint64_t i = ends.offsets[point]; i < ends.offsets[point + 1]; ++i)
      {
        if (!taken[ends.ends[i] / 2])
        {
          branches.push_back(FollowLine(ends.ends[i], lines, ends, stop, taken));
          loopStart[point] |= isLoops ? 1 : 0;
        }
      }
    }
  }
  // A loop of a single line that begins and ends in a point of its own.
  for (const auto & branch : branches)
  {
    if (branch.front() == branch.back() && ends.count[branch.front()] == 2 && !onFace[branch.front()] &&
        !isContact(branch.front()))
    {
      loopStart[branch.front()] = 1;
    }
  }

  graph.nodePoints.clear();
  graph.nodeKinds.clear();
  std::vector<ElementIndex> nodeOf(count, kNone);
  for (std::size_t point = 0; point < count; ++point)
  {
    const bool isIsolated = !onLine[point] && !onFace[point];
    if (stop[point] || loopStart[point] || isIsolated)
    {
      nodeOf[point] = static_cast<ElementIndex>(graph.nodePoints.size());
      graph.nodePoints.push_back(static_cast<ElementIndex>(point));
      graph.nodeKinds.push_back(isIsolated                                   ? NodeKind::Isolated
                                : loopStart[point]                           ? NodeKind::Loop
                                : onFace[point]                              ? NodeKind::Surface
                                : isContact(point) && ends.count[point] <= 2 ? NodeKind::Contact
                                : ends.count[point] == 1                     ? NodeKind::Tip
                                                                             : NodeKind::Junction);
    }
  }
  AddBranches(graph, std::move(branches), nodeOf);
}

SkeletonGraph
BuildSkeletonGraph(const CurveSkeleton & skeleton)
{
  const CellComplex & cells = skeleton.complex.cells;
  SkeletonGraph       graph;
  graph.positions = skeleton.places;
  graph.medial = skeleton.places;
  graph.radius = skeleton.complex.radius;
  graph.erosionThickness = skeleton.erosionThickness;
  graph.faceOffsets = cells.faceOffsets;
  graph.faceVertices = cells.faceVertices;
  graph.closedFace = skeleton.closedFace;
  std::vector<std::uint8_t> onFace(cells.edges.size(), 0);
  for (const ElementIndex edge : cells.faceEdges)
  {
    onFace[edge] = 1;
  }
  std::vector<std::vector<ElementIndex>> lines;
  for (std::size_t edge = 0; edge < cells.edges.size(); ++edge)
  {
    if (!onFace[edge])
    {
      lines.push_back({ cells.edges[edge][0], cells.edges[edge][1] });
    }
  }
  SortBranches(graph, lines, true);
  return graph;
}

std::vector<ElementIndex>
NodeHubs(const SkeletonGraph & graph)
{
  UnionFind                 surfaces(graph.positions.size());
  std::vector<std::uint8_t> onFace(graph.positions.size(), 0);
  for (std::size_t face = 0; face < graph.FaceCount(); ++face)
  {
    for (std::uint64_t i = graph.faceOffsets[face]; i < graph.faceOffsets[face + 1]; ++i)
    {
      surfaces.Unite(graph.faceVertices[graph.faceOffsets[face]], graph.faceVertices[i]);
      onFace[graph.faceVertices[i]] = 1;
    }
  }
  std::vector<ElementIndex> hubOfSurface(graph.positions.size(), kNone);
  std::vector<ElementIndex> hubs(graph.nodePoints.size());
  ElementIndex              count = 0;
  for (std::size_t node = 0; node < hubs.size(); ++node)
  {
    const ElementIndex point = graph.nodePoints[node];
    if (!onFace[point])
    {
      hubs[node] = count++;
      continue;
    }
    ElementIndex & hub = hubOfSurface[surfaces.Find(point)];
    hub = hub == kNone ? count++ : hub;
    hubs[node] = hub;
  }
  return hubs;
}

} // namespace voxelcore
