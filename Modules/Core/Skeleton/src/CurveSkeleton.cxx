#include "voxelcore/Skeleton/CurveSkeleton.h"

#include "CurveBranches.h"
#include "CurveFire.h"
#include "PartOfCurves.h"
#include "SurfaceCollapse.h"
#include "TurnedSurface.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Base/StagePlan.h"
#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace voxelcore
{

namespace
{

// The zigzag of the curve over edges of the complex is about a voxel wide; chords as long as this many mean edges see
// little of it.
constexpr double kChordInEdges = 5;

double
MeanEdgeLength(const MedialComplex & surface)
{
  double sum = 0;
  for (const auto & ends : surface.cells.edges)
  {
    sum += Distance(surface.positions[ends[0]], surface.positions[ends[1]]);
  }
  return surface.cells.edges.empty() ? 0 : sum / static_cast<double>(surface.cells.edges.size());
}

std::vector<std::uint32_t>
LiveDegrees(const CellComplex & cells, const LiveElements & live)
{
  std::vector<std::uint32_t> degree(cells.vertexCount, 0);
  for (std::size_t edge = 0; edge < cells.edges.size(); ++edge)
  {
    if (live.edges[edge])
    {
      ++degree[cells.edges[edge][0]];
      ++degree[cells.edges[edge][1]];
    }
  }
  return degree;
}

/** Where the end of a branch is: so much of the way from a vertex that is gone to the last one. */
struct EndPlace
{
  ElementIndex vertex;
  ElementIndex beyond;
  double       part;
};

Vector3
PlaceOf(const EndPlace & end, const std::vector<Vector3> & positions)
{
  Vector3 place{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double from = positions[end.beyond][axis];
    place[axis] = from + end.part * (positions[end.vertex][axis] - from);
  }
  return place;
}

/** Takes off the branches that are not there, and of the others what lies beyond their end or, where that is beyond a
 *  junction, beyond the junction. */
void
KeepBranches(const CellComplex &              cells,
             const CurveFire &                fire,
             const std::vector<CurveBranch> & branches,
             LiveElements &                   live,
             std::vector<EndPlace> &          ends)
{
  std::vector<std::uint8_t> kept(cells.vertexCount, 0);
  for (const CurveBranch & branch : branches)
  {
    for (const ElementIndex vertex : branch.path)
    {
      kept[vertex] = 1;
    }
  }
  for (const ElementIndex vertex : fire.order)
  {
    if (!kept[vertex] && fire.nextEdge[vertex] != kNoEdge)
    {
      live.vertices[vertex] = 0;
      live.edges[fire.nextEdge[vertex]] = 0;
    }
  }
  std::vector<std::uint32_t> degree = LiveDegrees(cells, live);
  for (const CurveBranch & branch : branches)
  {
    // The vertex after the place becomes the end.
    const std::size_t last = branch.part > 0 ? branch.end + 1 : branch.end;
    std::size_t       at = 0;
    while (at < last && degree[branch.path[at]] <= 1)
    {
      live.vertices[branch.path[at]] = 0;
      live.edges[fire.nextEdge[branch.path[at]]] = 0;
      ++at;
      --degree[branch.path[at]];
    }
    if (at == last && branch.part > 0 && degree[branch.path[last]] == 1)
    {
      ends.push_back({ branch.path[last], branch.path[branch.end], branch.part });
    }
  }
}

std::vector<TipPlace>
TipsOf(const MedialComplex &              surface,
       const LiveElements &               live,
       const std::vector<EndPlace> &      ends,
       const std::vector<std::uint32_t> & components)
{
  const CellComplex &        cells = surface.cells;
  std::vector<Vector3>       places = surface.positions;
  std::vector<std::uint32_t> degree = LiveDegrees(cells, live);
  for (const EndPlace & end : ends)
  {
    places[end.vertex] = PlaceOf(end, surface.positions);
  }
  std::vector<TipPlace> tips;
  for (std::size_t vertex = 0; vertex < degree.size(); ++vertex)
  {
    if (live.vertices[vertex] && degree[vertex] == 1)
    {
      tips.push_back({ places[vertex], components[vertex] });
    }
  }
  return tips;
}

} // namespace

std::size_t
CurveSkeleton::ClosedFaceCount() const
{
  return static_cast<std::size_t>(std::count(closedFace.begin(), closedFace.end(), std::uint8_t{ 1 }));
}

namespace
{

/** `positions` are those of the surface as it was; `part` is null, or by its elements. */
CurveSkeleton
BurnTurned(TurnedSurface &              turned,
           const std::vector<Vector3> & positions,
           const LiveElements *         part,
           const CurveOptions &         options,
           const ProgressCallback &     progress)
{
  StagePlan plan(progress, { 0.9, 0.06, 0.04 });
  BurnTimes times = ComputeBurnTimes(turned.surface, options.sampling, plan.Next());
  ReportProgress(plan.Next("collapsing"), "", 0);
  std::vector<std::uint8_t> closed;
  const double              chord = kChordInEdges * MeanEdgeLength(turned.surface);
  LiveElements              live = CollapseSurface(turned.surface, times, options.plateThreshold, closed);
  ReportProgress(plan.Next("curves"), "", 0);
  CurveFire             fire = BurnCurves(turned.surface, live, times.vertices, chord);
  std::vector<EndPlace> ends;
  if (options.branchThreshold > 0)
  {
    KeepBranches(
      turned.surface.cells,
      fire,
      StandingBranches(turned.surface, fire, times.vertices, { chord, options.voxel }, options.branchThreshold),
      live,
      ends);
  }
  if (part != nullptr)
  {
    std::vector<std::uint32_t>  components = ComponentOfVertices(turned.surface.cells);
    const std::vector<TipPlace> tips = TipsOf(turned.surface, live, ends, components);
    ends.clear();
    KeepPart(*part, turned, times, components);
    live = CollapseSurface(turned.surface, times, options.plateThreshold, closed);
    fire = BurnCurves(turned.surface, live, times.vertices, chord);
    if (options.branchThreshold > 0)
    {
      KeepWaysBetween(tips, turned.surface, components, fire, live);
    }
  }

  // Back to the surface as it was.
  std::vector<double>().swap(times.edges);
  std::vector<double>().swap(times.faces);
  std::vector<std::uint8_t> closedBefore(turned.faces.empty() ? 0 : 1 + *ranges::max_element(turned.faces), 0);
  for (std::size_t i = 0; i < turned.faces.size(); ++i)
  {
    closedBefore[turned.faces[i]] = closed[i];
  }
  std::vector<ElementIndex> vertexNow(positions.size(), 0);
  for (std::size_t i = 0; i < turned.vertices.size(); ++i)
  {
    vertexNow[turned.vertices[i]] = static_cast<ElementIndex>(i);
  }

  CurveSkeleton skeleton;
  skeleton.complex.cells = CellsBefore(turned, live, skeleton.inSurface);
  for (const ElementIndex vertex : skeleton.inSurface.vertices)
  {
    skeleton.complex.positions.push_back(positions[vertex]);
    skeleton.complex.radius.push_back(turned.surface.radius[vertexNow[vertex]]);
  }
  skeleton.places = skeleton.complex.positions;
  for (const EndPlace & end : ends)
  {
    const EndPlace there{ turned.vertices[end.vertex], turned.vertices[end.beyond], end.part };
    const auto &   left = skeleton.inSurface.vertices;
    const auto     at = ranges::lower_bound(left, there.vertex);
    if (at != left.end() && *at == there.vertex)
    {
      skeleton.places[static_cast<std::size_t>(at - left.begin())] = PlaceOf(there, positions);
    }
  }
  for (const ElementIndex vertex : skeleton.inSurface.vertices)
  {
    const ElementIndex now = vertexNow[vertex];
    const double       surfaceTime = times.vertices[now];
    const double       curveTime = fire.time[now];
    skeleton.erosionThickness.push_back(surfaceTime - turned.surface.radius[now]);
    skeleton.branchThickness.push_back(curveTime < std::numeric_limits<double>::infinity()
                                         ? std::max(0.0, curveTime - surfaceTime)
                                         : std::numeric_limits<double>::infinity());
  }
  for (const ElementIndex face : skeleton.inSurface.faces)
  {
    skeleton.closedFace.push_back(closedBefore[face]);
  }
  return skeleton;
}

} // namespace

CurveSkeleton
ComputeCurveSkeleton(const MedialComplex &    surface,
                     const LiveElements *     part,
                     const CurveOptions &     options,
                     const ProgressCallback & progress)
{
  TurnedSurface turned = TurnSurface(surface, options.geometry);
  return BurnTurned(turned, surface.positions, part, options, progress);
}

CurveSkeleton
ComputeCurveSkeleton(MedialComplex & surface, const CurveOptions & options, const ProgressCallback & progress)
{
  TurnedSurface turned = TurnSurface(surface, options.geometry);
  surface.cells = CellComplex();
  std::vector<double>().swap(surface.radius);
  CurveSkeleton skeleton = BurnTurned(turned, surface.positions, nullptr, options, progress);
  surface.cells = CellsBefore(turned);
  surface.radius.resize(turned.vertices.size());
  for (std::size_t i = 0; i < turned.vertices.size(); ++i)
  {
    surface.radius[turned.vertices[i]] = turned.surface.radius[i];
  }
  return skeleton;
}

CurveSkeleton
ComputeCurveSkeleton(const MedialComplex & surface, const CurveOptions & options, const ProgressCallback & progress)
{
  return ComputeCurveSkeleton(surface, nullptr, options, progress);
}

} // namespace voxelcore
