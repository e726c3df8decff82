#include "voxelcore/CurveSkeleton.h"

#include "CurveFire.h"
#include "PointGeometry.h"
#include "SurfaceCollapse.h"

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

// Balls in a voxel shape end at the nearest corner, its caps do not: measured on tubes at all angles.
constexpr double kCapBeyondBall = 0.9; // voxels

/** The first point of a path, from `start` on, that is as far from the path's end as the radius has grown since: there,
 *  whatever way the end lies, is the centre of the ball that closes a tube. The radius is a mean over `window`. */
std::size_t
CapCentre(const MedialComplex &             surface,
          const CurveFire &                 fire,
          const std::vector<ElementIndex> & path,
          std::size_t                       start,
          double                            window,
          double                            voxel)
{
  const auto way = [&](std::size_t from, std::size_t to) { return fire.length[path[to]] - fire.length[path[from]]; };
  for (; start + 1 < path.size(); ++start)
  {
    double      sum = 0;
    std::size_t at = start;
    for (; at < path.size() && way(start, at) <= window; ++at)
    {
      sum += surface.radius[path[at]];
    }
    if (way(0, start) >= sum / static_cast<double>(at - start) - surface.radius[path[0]] + kCapBeyondBall * voxel)
    {
      break;
    }
  }
  return start;
}

/** Takes off the outermost part of each branch up to where the curve begins to run along the middle of the surface, seen
 *  over a way of a few edges: fire on the curve falls behind there. */
void
TrimEnds(const MedialComplex &       surface,
         const CurveFire &           fire,
         const std::vector<double> & surfaceTime,
         double                      edgeLength,
         double                      voxel,
         LiveElements &              live)
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
    const auto way = [&](std::size_t from, std::size_t to) { return fire.length[path[to]] - fire.length[path[from]]; };
    // Where the fire of a branch that is gone took over, the ways before and after cannot be compared.
    const auto goesOn = [&](std::size_t at) {
      return at + 1 < path.size() && fire.winner[path[at + 1]] == fire.nextEdge[path[at]];
    };
    std::size_t start = 0;
    for (; start + 1 < path.size(); ++start)
    {
      std::size_t end = start;
      while (way(start, end) < window && goesOn(end))
      {
        ++end;
      }
      if (2 * way(start, end) >= window && late(end) - late(start) >= kRunsAlongTheMiddle * way(start, end))
      {
        start = CapCentre(surface, fire, path, start, window, voxel);
        break;
      }
    }
    for (std::size_t at = 0; at < start; ++at)
    {
      live.vertices[path[at]] = 0;
      live.edges[fire.nextEdge[path[at]]] = 0;
      --degree[path[at + 1]];
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
  const BurnTimes           times = ComputeBurnTimes(surface, options.sampling, progress);
  std::vector<std::uint8_t> closed;
  LiveElements              live = CollapseSurface(surface, times, options.plateThreshold, closed);
  ReportProgress(progress, "skeleton", 0);
  const double    edgeLength = MeanEdgeLength(surface);
  const CurveFire fire = BurnCurves(surface, live, times.vertices, kChordInEdges * edgeLength);
  if (options.branchThreshold > 0)
  {
    RemoveBranches(surface.cells, fire, options.branchThreshold, live);
    TrimEnds(surface, fire, times.vertices, edgeLength, options.voxel, live);
  }

  CurveSkeleton             skeleton;
  std::vector<ElementIndex> vertices;
  std::vector<ElementIndex> edges;
  std::vector<ElementIndex> faces;
  skeleton.complex.cells = ExtractLive(surface.cells, live, vertices, edges, faces);
  for (const ElementIndex vertex : vertices)
  {
    skeleton.complex.positions.push_back(surface.positions[vertex]);
    skeleton.complex.radius.push_back(surface.radius[vertex]);
    skeleton.complex.vertexLambda.push_back(surface.vertexLambda[vertex]);
    skeleton.erosionThickness.push_back(times.vertices[vertex] - surface.radius[vertex]);
    skeleton.branchThickness.push_back(fire.time[vertex] < std::numeric_limits<double>::infinity()
                                         ? std::max(0.0, fire.time[vertex] - times.vertices[vertex])
                                         : std::numeric_limits<double>::infinity());
  }
  for (const ElementIndex edge : edges)
  {
    skeleton.complex.edgeLambda.push_back(surface.edgeLambda[edge]);
  }
  for (const ElementIndex face : faces)
  {
    skeleton.complex.faceLambda.push_back(surface.faceLambda[face]);
    skeleton.closedFace.push_back(closed[face]);
  }
  return skeleton;
}

} // namespace voxelcore
