#include "CurveFire.h"

#include "TimeHeap.h"
#include "voxelcore/Vectors.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace voxelcore
{

namespace
{

constexpr double kNever = std::numeric_limits<double>::infinity();

} // namespace

CurveFire
BurnCurves(const MedialComplex &       surface,
           const LiveElements &        live,
           const std::vector<double> & surfaceTime,
           double                      chord)
{
  const CellComplex & cells = surface.cells;
  const std::size_t   count = cells.vertexCount;
  CurveFire           fire;
  fire.nextEdge.assign(count, kNoEdge);
  fire.time.assign(count, 0);
  fire.length.assign(count, 0);
  fire.prominence.assign(count, 0);
  fire.winner.assign(count, kNoEdge);
  fire.runnerUp.assign(count, kNoEdge);

  std::vector<Cofaces>      degrees(count); // of the live edges at each vertex
  std::vector<std::uint8_t> pinned(count, 0);
  for (ElementIndex edge = 0; edge < cells.edges.size(); ++edge)
  {
    if (live.edges[edge])
    {
      for (const ElementIndex vertex : cells.edges[edge])
      {
        degrees[vertex].Add(edge);
      }
    }
  }
  for (std::size_t face = 0; face < cells.FaceCount(); ++face)
  {
    if (live.faces[face])
    {
      for (const ElementIndex vertex : cells.FaceVertices(face))
      {
        pinned[vertex] = 1;
      }
    }
  }

  // Where the fire that burned a vertex last had its way measured: from this vertex on, at this time, at this length.
  struct Anchor
  {
    ElementIndex vertex;
    double       time;
    double       length;
  };
  std::vector<Anchor> anchors(count);
  // The same for the fire that has come the longest way. Short twigs at a right angle to it often win by a hair, and
  // from their anchors the next step would seem to take no time.
  std::vector<Anchor> longest(count, { kNoEdge, 0, 0 });
  // What goes on as a branch is decided by the whole way along the edges: straight lines from the tips of twigs that
  // stand across a branch grow so slowly along it that each next twig would seem to have come as far.
  std::vector<double> way(count, 0);
  std::vector<double> runnerUpWay(count, 0);
  std::vector<double> pushed(count, kNever);
  TimeHeap            heap(FireBucket(surface.radius));
  const auto          push = [&](ElementIndex vertex) {
    pushed[vertex] = fire.time[vertex];
    heap.Push({ fire.time[vertex], vertex });
  };
  const auto kindle = [&](ElementIndex vertex) {
    const double late = fire.time[vertex] - surfaceTime[vertex];
    if (late < 0 || fire.winner[vertex] == kNoEdge)
    {
      // The surface burned later than the way along the curve says: its fire counts.
      fire.time[vertex] = surfaceTime[vertex];
      way[vertex] = surfaceTime[vertex];
      anchors[vertex] = { vertex, surfaceTime[vertex], fire.length[vertex] };
    }
    else if (Distance(surface.positions[anchors[vertex].vertex], surface.positions[vertex]) > chord)
    {
      anchors[vertex] = { vertex, fire.time[vertex], fire.length[vertex] };
    }
    Anchor & far = longest[vertex];
    if (far.vertex == kNoEdge || anchors[vertex].vertex == vertex)
    {
      far = anchors[vertex];
    }
    else if (Distance(surface.positions[far.vertex], surface.positions[vertex]) > chord)
    {
      far = { vertex,
              fire.time[vertex],
              far.length + Distance(surface.positions[far.vertex], surface.positions[vertex]) };
    }
    fire.prominence[vertex] = std::max(fire.prominence[vertex], fire.time[vertex] - surfaceTime[vertex]);
  };
  for (ElementIndex vertex = 0; vertex < count; ++vertex)
  {
    if (live.vertices[vertex] && degrees[vertex].count <= 1 && !pinned[vertex])
    {
      kindle(vertex);
      push(vertex);
    }
  }
  const auto   due = [&](ElementIndex vertex) { return pushed[vertex]; };
  TimedElement item;
  while (heap.Pop(due, item))
  {
    if (const ElementIndex ahead = heap.Ahead(8); ahead != TimeHeap::none)
    {
      __builtin_prefetch(&degrees[ahead], 1);
      __builtin_prefetch(&fire.nextEdge[ahead], 1);
      __builtin_prefetch(&fire.time[ahead], 1);
      __builtin_prefetch(&fire.prominence[ahead], 1);
      __builtin_prefetch(&anchors[ahead], 1);
      __builtin_prefetch(&longest[ahead], 1);
      __builtin_prefetch(&surface.positions[ahead]);
    }
    if (const ElementIndex ahead = heap.Ahead(4); ahead != TimeHeap::none && degrees[ahead].count > 0)
    {
      __builtin_prefetch(&cells.edges[degrees[ahead].exclusiveOr]);
    }
    const ElementIndex vertex = item.element;
    fire.order.push_back(vertex);
    if (degrees[vertex].count == 0)
    {
      continue; // the last of its component
    }
    const ElementIndex edge = degrees[vertex].exclusiveOr;
    const ElementIndex next = cells.edges[edge][0] ^ cells.edges[edge][1] ^ vertex;
    fire.nextEdge[vertex] = edge;
    degrees[vertex].count = 0;
    degrees[next].Remove(edge);

    const Anchor & anchor = anchors[vertex];
    const Anchor & far = longest[vertex];
    const double   step = Distance(surface.positions[anchor.vertex], surface.positions[next]);
    const double   farStep = Distance(surface.positions[far.vertex], surface.positions[next]);
    const double   arrival = std::max({ fire.time[vertex], anchor.time + step, far.time + farStep });
    if (longest[next].vertex == kNoEdge ||
        far.length + farStep >
          longest[next].length + Distance(surface.positions[longest[next].vertex], surface.positions[next]))
    {
      longest[next] = far;
    }
    const double whole = way[vertex] + Distance(surface.positions[vertex], surface.positions[next]);
    if (fire.winner[next] == kNoEdge || whole > way[next])
    {
      fire.runnerUp[next] = fire.winner[next];
      runnerUpWay[next] = way[next];
      fire.winner[next] = edge;
      way[next] = whole;
      fire.length[next] = anchor.length + step;
      anchors[next] = anchor;
    }
    else if (fire.runnerUp[next] == kNoEdge || whole > runnerUpWay[next])
    {
      fire.runnerUp[next] = edge;
      runnerUpWay[next] = whole;
    }
    fire.time[next] = std::max(fire.time[next], arrival);
    // What came in counts for what goes out, or the part of a branch behind a shorter one could be cut off.
    fire.prominence[vertex] = std::max(fire.prominence[vertex], arrival - surfaceTime[next]);
    fire.prominence[next] = std::max(fire.prominence[next], fire.prominence[vertex]);
    if (pinned[next])
    {
      continue;
    }
    if (degrees[next].count == 1)
    {
      kindle(next);
      push(next);
    }
    else if (degrees[next].count == 0)
    {
      // Two fires met on this edge; `next` waits in the heap already.
      fire.prominence[next] = std::max(fire.prominence[next], fire.prominence[vertex]);
    }
  }
  std::vector<std::uint8_t> burned(count, 0);
  for (const ElementIndex vertex : fire.order)
  {
    burned[vertex] = 1;
  }
  for (std::size_t vertex = 0; vertex < count; ++vertex)
  {
    if (!burned[vertex])
    {
      fire.time[vertex] = kNever;
    }
  }
  return fire;
}

} // namespace voxelcore
