#include "voxelcore/CurveSkeleton.h"

#include "CurveFire.h"
#include "SurfaceCollapse.h"
#include "TurnedSurface.h"
#include "voxelcore/StagePlan.h"
#include "voxelcore/Vectors.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace voxelcore
{

namespace
{

// Where the curve runs along the middle of the surface, fire along it falls behind as fast as it goes; into a corner of
// the surface of 90 degrees by 0.29 of the way, into a corner of a box by 0.42 of it.
constexpr double kRunsAlongTheMiddle = 0.5;

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

/** Takes off the branches below the threshold: the fire of each is kept or lost as a whole. */
void
RemoveBranches(const CellComplex & cells, const CurveFire & fire, double threshold, LiveElements & live)
{
  std::vector<std::uint8_t> kept(cells.vertexCount, 0); // whether the edge by which fire left the vertex stays
  for (auto at = fire.order.rbegin(); at != fire.order.rend(); ++at)
  {
    const ElementIndex vertex = *at;
    const ElementIndex edge = fire.nextEdge[vertex];
    if (edge == kNoEdge)
    {
      continue;
    }
    const ElementIndex next = cells.edges[edge][0] ^ cells.edges[edge][1] ^ vertex;
    const bool nextIsLast = fire.nextEdge[next] == kNoEdge && fire.time[next] < std::numeric_limits<double>::infinity();
    const bool continues = fire.winner[next] == edge || (nextIsLast && fire.runnerUp[next] == edge);
    const bool nextStays = nextIsLast ? fire.prominence[next] >= threshold : kept[next] != 0;
    kept[vertex] = fire.prominence[vertex] >= threshold || (continues && nextStays);
    if (!kept[vertex])
    {
      live.edges[edge] = 0;
      live.vertices[vertex] = 0;
    }
  }
}

// Balls in a voxel shape end at the nearest corner, its caps do not. A curve that begins in a corner has so much
// further to go than its radius grows; one that begins with the ball it keeps, when that is as thin as a line of
// voxels, half of it; a thick one begins in the centre. Measured on tubes and tapering roots at all angles; voxels.
constexpr double kCornerBeyondBall = 1.25;
constexpr double kLineBeyondBall = 0.6;

/** A place on a path: so much of the way from a point to the one after it. */
struct PathPlace
{
  std::size_t point = 0;
  double      part = 0;
};

/** The first place on a path, from point `start` on, that is as far from the path's end as the radius has grown since:
 *  there, whatever way the end lies, is the centre of the ball that closes a tube. The radius is a mean over
 *  `window`. */
PathPlace
CapCentre(const MedialComplex &             surface,
          const std::vector<ElementIndex> & path,
          std::size_t                       start,
          double                            window,
          double                            voxel)
{
  const auto way = [&](std::size_t from, std::size_t to) {
    return Distance(surface.positions[path[from]], surface.positions[path[to]]);
  };
  // How much further from the end a point lies than it must.
  const auto excess = [&](std::size_t from) {
    double      sum = 0;
    std::size_t at = from;
    for (; at < path.size() && way(from, at) <= window; ++at)
    {
      sum += surface.radius[path[at]];
    }
    const double grown = sum / static_cast<double>(at - from) - surface.radius[path[0]];
    const double beyond = grown > 0.1 * voxel                   ? kCornerBeyondBall
                          : surface.radius[path[0]] < 2 * voxel ? kLineBeyondBall
                                                                : 0;
    return way(0, from) - grown - beyond * voxel;
  };
  double before = excess(start);
  if (before >= 0)
  {
    return { start, 0 };
  }
  while (start + 2 < path.size())
  {
    const double after = excess(start + 1);
    if (after >= 0)
    {
      return { start, before / (before - after) };
    }
    before = after;
    ++start;
  }
  return { start, 0 };
}

/** Where the end of a branch is: so much of the way from a vertex that is gone to the last one. */
struct EndPlace
{
  ElementIndex vertex;
  ElementIndex beyond;
  double       part;
};

/** Takes off the outermost part of each branch up to where the curve begins to run along the middle of the surface,
 *  seen over a way of a few edges: fire on the curve falls behind there. */
void
TrimEnds(const MedialComplex &       surface,
         const CurveFire &           fire,
         const std::vector<double> & surfaceTime,
         double                      edgeLength,
         double                      voxel,
         LiveElements &              live,
         std::vector<EndPlace> &     ends)
{
  const CellComplex &        cells = surface.cells;
  const double               window = kChordInEdges * edgeLength;
  std::vector<std::uint32_t> degree(cells.vertexCount, 0);
  for (std::size_t edge = 0; edge < cells.edges.size(); ++edge)
  {
    if (live.edges[edge])
    {
      ++degree[cells.edges[edge][0]];
      ++degree[cells.edges[edge][1]];
    }
  }
  std::vector<ElementIndex> path; // from a tip to the next junction, or as far as fire went
  std::vector<ElementIndex> tips; // as they are now: what becomes an end by trimming is done
  std::copy_if(fire.order.begin(), fire.order.end(), std::back_inserter(tips), [&](ElementIndex vertex) {
    return live.vertices[vertex] && degree[vertex] == 1;
  });
  for (const ElementIndex tip : tips)
  {
    if (!live.vertices[tip] || degree[tip] != 1)
    {
      continue;
    }
    path.assign(1, tip);
    while ((path.size() == 1 || degree[path.back()] == 2) && fire.nextEdge[path.back()] != kNoEdge)
    {
      const ElementIndex edge = fire.nextEdge[path.back()];
      path.push_back(cells.edges[edge][0] ^ cells.edges[edge][1] ^ path.back());
    }
    const auto late = [&](std::size_t at) { return fire.time[path[at]] - surfaceTime[path[at]]; };
    const auto way = [&](std::size_t from, std::size_t to) {
      return Distance(surface.positions[path[from]], surface.positions[path[to]]);
    };
    // Where the fire of a branch that is gone took over, the ways before and after cannot be compared.
    const auto goesOn = [&](std::size_t at) {
      return at + 1 < path.size() && fire.winner[path[at + 1]] == fire.nextEdge[path[at]];
    };
    std::size_t start = 0;
    PathPlace   place;
    for (; start + 1 < path.size(); ++start)
    {
      place = { start, 0 };
      std::size_t end = start;
      while (way(start, end) < window && goesOn(end))
      {
        ++end;
      }
      if (2 * way(start, end) >= window && late(end) - late(start) >= kRunsAlongTheMiddle * way(start, end))
      {
        place = CapCentre(surface, path, start, window, voxel);
        break;
      }
    }
    if (start + 1 == path.size())
    {
      place = { start, 0 };
    }
    // The vertex after the place becomes the end.
    const std::size_t last = place.part > 0 ? place.point + 1 : place.point;
    for (std::size_t at = 0; at < last; ++at)
    {
      live.vertices[path[at]] = 0;
      live.edges[fire.nextEdge[path[at]]] = 0;
      --degree[path[at + 1]];
    }
    if (place.part > 0 && degree[path[last]] == 1)
    {
      ends.push_back({ path[last], path[place.point], place.part });
    }
  }
}

} // namespace

std::size_t
CurveSkeleton::ClosedFaceCount() const
{
  return static_cast<std::size_t>(std::count(closedFace.begin(), closedFace.end(), std::uint8_t{ 1 }));
}

CurveSkeleton
ComputeCurveSkeleton(const MedialComplex & surface, const CurveOptions & options, const ProgressCallback & progress)
{
  const TurnedSurface turned = TurnSurface(surface, options.geometry);
  StagePlan           plan(progress, { 0.9, 0.06, 0.04 });
  const BurnTimes     times = ComputeBurnTimes(turned.surface, options.sampling, plan.Next());
  ReportProgress(plan.Next("collapsing"), "", 0);
  std::vector<std::uint8_t> closed;
  LiveElements              live = CollapseSurface(turned.surface, times, options.plateThreshold, closed);
  ReportProgress(plan.Next("curves"), "", 0);
  const double          edgeLength = MeanEdgeLength(turned.surface);
  const CurveFire       fire = BurnCurves(turned.surface, live, times.vertices, kChordInEdges * edgeLength);
  std::vector<EndPlace> ends;
  if (options.branchThreshold > 0)
  {
    RemoveBranches(turned.surface.cells, fire, options.branchThreshold, live);
    TrimEnds(turned.surface, fire, times.vertices, edgeLength, options.voxel, live, ends);
  }

  // Back to the surface as it was.
  const auto back = [](const std::vector<ElementIndex> & places, const auto & values) {
    auto result = values;
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      result[places[i]] = values[i];
    }
    return result;
  };
  const LiveElements        stays{ back(turned.vertices, live.vertices),
                            back(turned.edges, live.edges),
                            back(turned.faces, live.faces) };
  const std::vector<double> surfaceTime = back(turned.vertices, times.vertices);
  const std::vector<double> curveTime = back(turned.vertices, fire.time);
  closed = back(turned.faces, closed);
  std::vector<Vector3> places = surface.positions;
  for (const EndPlace & end : ends)
  {
    const Vector3 & a = surface.positions[turned.vertices[end.beyond]];
    const Vector3 & b = surface.positions[turned.vertices[end.vertex]];
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      places[turned.vertices[end.vertex]][axis] = a[axis] + end.part * (b[axis] - a[axis]);
    }
  }

  CurveSkeleton skeleton;
  skeleton.complex = ExtractPart(surface, stays, skeleton.inSurface);
  for (const ElementIndex vertex : skeleton.inSurface.vertices)
  {
    skeleton.places.push_back(places[vertex]);
    skeleton.erosionThickness.push_back(surfaceTime[vertex] - surface.radius[vertex]);
    skeleton.branchThickness.push_back(curveTime[vertex] < std::numeric_limits<double>::infinity()
                                         ? std::max(0.0, curveTime[vertex] - surfaceTime[vertex])
                                         : std::numeric_limits<double>::infinity());
  }
  for (const ElementIndex face : skeleton.inSurface.faces)
  {
    skeleton.closedFace.push_back(closed[face]);
  }
  return skeleton;
}

} // namespace voxelcore
