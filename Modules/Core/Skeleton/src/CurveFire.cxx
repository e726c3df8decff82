#include "CurveFire.h"

#include "TimeHeap.h"
#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Base/Prefetch.h"
#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <new>
#include <type_traits>

namespace voxelcore
{

namespace
{

constexpr double kNever = std::numeric_limits<double>::infinity();

// Where the fire that burned a vertex last had its way measured: from this vertex on, at this time, at this length.
struct Anchor
{
  ElementIndex vertex;
  double       time;
  double       length;
};

// All that fire asks of a vertex: it jumps about, and so finds it in a few lines of memory.
struct Node
{
  Cofaces edges; // the live ones at it
  double  time = 0;
  double  prominence = 0;
  double  way = 0; // what goes on as a branch is decided by the whole way along the edges: straight lines from the
                   // tips of twigs that stand across a branch grow so slowly along it that each next twig would
                   // seem to have come as far
  double       runnerUpWay = 0;
  double       length = 0;
  ElementIndex nextEdge = kNoEdge;
  ElementIndex winner = kNoEdge;
  Anchor       anchor{};
  Anchor       longest{ kNoEdge, 0, 0 }; // the same for the fire that has come the longest way: short twigs at a right
                                         // angle to it often win by a hair, and from their anchors the next step would
                                         // seem to take no time
  double       pushed = kNever;
  ElementIndex runnerUp = kNoEdge;
  bool         isPinned = false;
  bool         hasBurned = false;
};

static_assert(std::is_trivially_destructible_v<Node>);

struct ReleaseNodes
{
  void
  operator()(Node * nodes) const
  {
    ::operator delete[](nodes);
  }
};

// Whose memory each thread that works on a part of them is the first to touch.
using NodeArray = std::unique_ptr<Node[], ReleaseNodes>;

} // namespace

CurveFire
BurnCurves(const MedialComplex &       surface,
           const LiveElements &        live,
           const std::vector<double> & surfaceTime,
           double                      chord)
{
  const CellComplex & cells = surface.cells;
  const std::size_t   count = cells.vertexCount;
  const bool          worthIt = count > 10000;
  CurveFire           fire;
  const NodeArray     nodes(static_cast<Node *>(::operator new[](count * sizeof(Node))));
  RunInParts(worthIt, count, [&](std::size_t first, std::size_t last) {
    std::uninitialized_fill(nodes.get() + first, nodes.get() + last, Node());
    for (ElementIndex edge = 0; edge < cells.edges.size(); ++edge)
    {
      if (live.edges[edge])
      {
        for (const ElementIndex vertex : cells.edges[edge])
        {
          if (vertex - first < last - first)
          {
            nodes[vertex].edges.Add(edge);
          }
        }
      }
    }
  });
  for (std::size_t face = 0; face < cells.FaceCount(); ++face)
  {
    if (live.faces[face])
    {
      for (const ElementIndex vertex : cells.FaceVertices(face))
      {
        nodes[vertex].isPinned = true;
      }
    }
  }
  TimeHeap   heap(FireBucket(surface.radius));
  const auto kindle = [&](ElementIndex vertex) {
    Node &          node = nodes[vertex];
    const double    time = surfaceTime[vertex];
    const double    late = node.time - time;
    const Vector3 & place = surface.positions[vertex];
    if (late < 0 || node.winner == kNoEdge)
    {
      // The surface burned later than the way along the curve says: its fire counts.
      node.time = time;
      node.way = time;
      node.anchor = { vertex, time, node.length };
    }
    else if (Distance(surface.positions[node.anchor.vertex], place) > chord)
    {
      node.anchor = { vertex, node.time, node.length };
    }
    Anchor & far = node.longest;
    if (far.vertex == kNoEdge || node.anchor.vertex == vertex)
    {
      far = node.anchor;
    }
    else if (const double step = Distance(surface.positions[far.vertex], place); step > chord)
    {
      far = { vertex, node.time, far.length + step };
    }
    node.prominence = std::max(node.prominence, node.time - time);
    node.pushed = node.time;
    heap.Push({ node.time, vertex });
  };
  for (ElementIndex vertex = 0; vertex < count; ++vertex)
  {
    if (live.vertices[vertex] && nodes[vertex].edges.count <= 1 && !nodes[vertex].isPinned)
    {
      kindle(vertex);
    }
  }
  const auto   due = [&](ElementIndex vertex) { return nodes[vertex].pushed; };
  TimedElement item;
  while (heap.Pop(due, item))
  {
    if (const ElementIndex ahead = heap.Ahead(12); ahead != TimeHeap::none)
    {
      FetchLine(&nodes[ahead]);
      FetchLine(&nodes[ahead].anchor);
      FetchLine(&surface.positions[ahead]);
    }
    if (const ElementIndex ahead = heap.Ahead(8); ahead != TimeHeap::none && nodes[ahead].edges.count > 0)
    {
      FetchLine(&cells.edges[nodes[ahead].edges.exclusiveOr]);
    }
    if (const ElementIndex ahead = heap.Ahead(4); ahead != TimeHeap::none && nodes[ahead].edges.count > 0)
    {
      const auto &       ends = cells.edges[nodes[ahead].edges.exclusiveOr];
      const ElementIndex beyond = ends[0] ^ ends[1] ^ ahead;
      FetchLine(&nodes[beyond]);
      FetchLine(&nodes[beyond].anchor);
      FetchLine(&surface.positions[beyond]);
      FetchLine(&surfaceTime[beyond]);
      FetchLine(&surface.positions[nodes[ahead].anchor.vertex]);
      FetchLine(&surface.positions[nodes[ahead].longest.vertex]);
    }
    const ElementIndex vertex = item.element;
    Node &             node = nodes[vertex];
    fire.order.push_back(vertex);
    node.hasBurned = true;
    if (node.edges.count == 0)
    {
      continue; // the last of its component
    }
    const ElementIndex edge = node.edges.exclusiveOr;
    const ElementIndex next = cells.edges[edge][0] ^ cells.edges[edge][1] ^ vertex;
    Node &             beyond = nodes[next];
    node.nextEdge = edge;
    node.edges.count = 0;
    beyond.edges.Remove(edge);

    const Vector3 & place = surface.positions[next];
    const Anchor &  anchor = node.anchor;
    const Anchor &  far = node.longest;
    const double    step = Distance(surface.positions[anchor.vertex], place);
    const double    farStep = Distance(surface.positions[far.vertex], place);
    const double    arrival = std::max({ node.time, anchor.time + step, far.time + farStep });
    if (beyond.longest.vertex == kNoEdge ||
        far.length + farStep > beyond.longest.length + Distance(surface.positions[beyond.longest.vertex], place))
    {
      beyond.longest = far;
    }
    const double whole = node.way + Distance(surface.positions[vertex], place);
    if (beyond.winner == kNoEdge || whole > beyond.way)
    {
      beyond.runnerUp = beyond.winner;
      beyond.runnerUpWay = beyond.way;
      beyond.winner = edge;
      beyond.way = whole;
      beyond.length = anchor.length + step;
      beyond.anchor = anchor;
    }
    else if (beyond.runnerUp == kNoEdge || whole > beyond.runnerUpWay)
    {
      beyond.runnerUp = edge;
      beyond.runnerUpWay = whole;
    }
    beyond.time = std::max(beyond.time, arrival);
    // What came in counts for what goes out, or the part of a branch behind a shorter one could be cut off.
    node.prominence = std::max(node.prominence, arrival - surfaceTime[next]);
    beyond.prominence = std::max(beyond.prominence, node.prominence);
    // Where no edge is left two fires met on this one, and `next` waits in the heap already.
    if (!beyond.isPinned && beyond.edges.count == 1)
    {
      kindle(next);
    }
  }
  RunBoth(
    worthIt,
    [&] {
      fire.time.resize(count);
      fire.nextEdge.resize(count);
      fire.winner.resize(count);
    },
    [&] {
      fire.length.resize(count);
      fire.prominence.resize(count);
      fire.runnerUp.resize(count);
    });
  RunInParts(worthIt, count, [&](std::size_t first, std::size_t last) {
    for (std::size_t vertex = first; vertex < last; ++vertex) // once, as nodes are long
    {
      const Node & node = nodes[vertex];
      fire.nextEdge[vertex] = node.nextEdge;
      fire.time[vertex] = node.hasBurned ? node.time : kNever;
      fire.length[vertex] = node.length;
      fire.prominence[vertex] = node.prominence;
      fire.winner[vertex] = node.winner;
      fire.runnerUp[vertex] = node.runnerUp;
    }
  });
  return fire;
}

} // namespace voxelcore
