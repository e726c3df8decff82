// What of a core is refined, and what of the rest is needed for that.

#include "Fringe.h"

#include "voxelcore/Base/UnionFind.h"
#include "voxelcore/Complex/SimplePairCollapse.h"
#include "voxelcore/Refinement/Refinement.h"
#include "voxelcore/VoxelCore/ExtractPart.h"
#include "voxelcore/VoxelCore/TolerancePruning.h"

#include <algorithm>

namespace voxelcore
{

namespace
{

// More is moved than is left in the end, as measures that are taken again may be greater.
constexpr double kWorkingPart = 0.75;

// Those of which a point may be left alone, as of a ball: of what is connected and has nothing that is no fringe.
std::vector<std::uint8_t>
MayBeAlone(const MedialComplex & core, const LiveElements & part, double widestFringe)
{
  const CellComplex &       cells = core.cells;
  std::vector<std::uint8_t> onFace(cells.edges.size(), 0);
  std::vector<std::uint8_t> stays(cells.vertexCount, 0);
  for (std::size_t face = 0; face < cells.FaceCount(); ++face)
  {
    for (const ElementIndex edge : cells.FaceEdges(face))
    {
      onFace[edge] = part.faces[face] != 0 ? 1 : onFace[edge];
    }
    if (part.faces[face] != 0 && core.faceLambda[face] >= widestFringe)
    {
      stays[cells.FaceVertices(face)[0]] = 1;
    }
  }
  UnionFind connected(cells.vertexCount);
  for (std::size_t edge = 0; edge < onFace.size(); ++edge)
  {
    if (part.edges[edge] != 0)
    {
      connected.Unite(cells.edges[edge][0], cells.edges[edge][1]);
      if (onFace[edge] == 0 && core.edgeLambda[edge] >= widestFringe)
      {
        stays[cells.edges[edge][0]] = 1;
      }
    }
  }
  for (std::size_t vertex = 0; vertex < stays.size(); ++vertex)
  {
    if (stays[vertex] != 0)
    {
      stays[connected.Find(vertex)] = 1;
    }
  }
  std::vector<std::uint8_t> alone(cells.vertexCount);
  for (std::size_t vertex = 0; vertex < alone.size(); ++vertex)
  {
    alone[vertex] = part.vertices[vertex] != 0 && stays[connected.Find(vertex)] == 0 ? 1 : 0;
  }
  return alone;
}

// What is in any of the parts, and of a point that may be left alone all its edges.
LiveElements
NeededFor(const MedialComplex & core, const std::vector<const LiveElements *> & parts, double widestFringe)
{
  const CellComplex & cells = core.cells;
  LiveElements        needed{ std::vector<std::uint8_t>(cells.vertexCount, 0),
                       std::vector<std::uint8_t>(cells.edges.size(), 0),
                       std::vector<std::uint8_t>(cells.FaceCount(), 0) };
  const auto          add = [](const std::vector<std::uint8_t> & flags, std::vector<std::uint8_t> & to) {
    std::transform(flags.begin(), flags.end(), to.begin(), to.begin(), [](std::uint8_t one, std::uint8_t other) {
      return static_cast<std::uint8_t>(one | other);
    });
  };
  for (const LiveElements * part : parts)
  {
    add(part->vertices, needed.vertices);
    add(part->edges, needed.edges);
    add(part->faces, needed.faces);
  }
  for (const LiveElements * part : parts)
  {
    const std::vector<std::uint8_t> alone = MayBeAlone(core, *part, widestFringe);
    for (std::size_t edge = 0; edge < needed.edges.size(); ++edge)
    {
      const auto & [from, to] = cells.edges[edge];
      if ((alone[from] | alone[to]) != 0)
      {
        needed.edges[edge] = needed.vertices[from] = needed.vertices[to] = 1;
      }
    }
  }
  return needed;
}

} // namespace

std::vector<LiveElements>
LeftToRefine(const MedialComplex &       core,
             const std::vector<double> & thresholds,
             bool                        byTolerance,
             const ProgressCallback &    progress)
{
  std::vector<LiveElements> left;
  if (byTolerance)
  {
    std::transform(thresholds.begin(), thresholds.end(), std::back_inserter(left), [&](double threshold) {
      return LeftByTolerance(core, threshold);
    });
  }
  else if (!thresholds.empty())
  {
    SimplePairCollapse collapse(core.cells, core.vertexLambda, core.edgeLambda, core.faceLambda);
    for (const double threshold : thresholds)
    {
      collapse.CollapseBelow(kWorkingPart * threshold, progress);
      left.push_back(collapse.Live());
    }
  }
  return left;
}

MedialComplex
KeepToRefine(const Vector3 &             spacing,
             const MedialComplex &       core,
             EdgePoints &                edgePoints,
             std::vector<LatticePoint> & points,
             std::vector<LiveElements> & left,
             std::vector<LiveElements> & parts)
{
  std::vector<const LiveElements *> all;
  for (auto * const some : { &left, &parts })
  {
    std::transform(some->begin(), some->end(), std::back_inserter(all), [](const LiveElements & part) {
      return &part;
    });
  }
  PartElements  kept;
  MedialComplex part = ExtractPart(core, NeededFor(core, all, WidestFringe(spacing)), kept);
  const auto    pick = [](std::vector<std::uint8_t> & flags, const std::vector<ElementIndex> & indices) {
    std::vector<std::uint8_t> some(indices.size());
    std::transform(indices.begin(), indices.end(), some.begin(), [&](ElementIndex index) { return flags[index]; });
    flags = std::move(some);
  };
  for (auto * const some : { &left, &parts })
  {
    for (LiveElements & one : *some)
    {
      pick(one.vertices, kept.vertices);
      pick(one.edges, kept.edges);
      pick(one.faces, kept.faces);
    }
  }
  EdgePoints                 nearest;
  std::vector<std::uint32_t> names(points.size(), 0);
  std::uint64_t              ends = 0;
  for (const ElementIndex edge : kept.edges)
  {
    for (const std::uint32_t point : edgePoints.Of(edge))
    {
      names[point] = 1;
      ++ends;
    }
  }
  nearest.points.reserve(ends);
  nearest.offsets.reserve(kept.edges.size() + 1);
  std::vector<LatticePoint> named;
  for (std::size_t point = 0; point < points.size(); ++point)
  {
    if (names[point] != 0)
    {
      names[point] = static_cast<std::uint32_t>(named.size());
      named.push_back(points[point]);
    }
  }
  for (const ElementIndex edge : kept.edges)
  {
    for (const std::uint32_t point : edgePoints.Of(edge))
    {
      nearest.points.push_back(names[point]);
    }
    nearest.offsets.push_back(static_cast<std::uint32_t>(nearest.points.size()));
  }
  edgePoints = std::move(nearest);
  points = std::move(named);
  return part;
}

} // namespace voxelcore
