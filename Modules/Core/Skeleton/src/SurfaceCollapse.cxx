#include "SurfaceCollapse.h"

#include "TimeHeap.h"
#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Base/Prefetch.h"
#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <limits>

namespace voxelcore
{

namespace
{

/** Per edge the faces that are left. */
class EdgeCofaces
{
public:
  EdgeCofaces() = default;

  explicit EdgeCofaces(const CellComplex & cells)
    : m_Cells(&cells)
    , m_Cofaces(CountEdgeCofaces(cells))
  {}

  bool
  IsFree(ElementIndex edge) const
  {
    return m_Cofaces[edge].count == 1;
  }

  ElementIndex
  OnlyFace(ElementIndex edge) const
  {
    return m_Cofaces[edge].exclusiveOr;
  }

  void
  Fetch(ElementIndex edge) const
  {
    FetchLine(&m_Cofaces[edge]);
  }

  void
  Remove(ElementIndex face)
  {
    for (const ElementIndex edge : m_Cells->FaceEdges(face))
    {
      m_Cofaces[edge].Remove(face);
    }
  }

private:
  const CellComplex *  m_Cells = nullptr;
  std::vector<Cofaces> m_Cofaces;
};

// Ways over sample points are longer than straight ones, those to vertices less so: an edge that fire reaches from the
// side would seem to burn after both its ends.
std::vector<double>
TimesOfEdges(const CellComplex & cells, const BurnTimes & times)
{
  std::vector<double> edges = times.edges;
  for (std::size_t edge = 0; edge < edges.size(); ++edge)
  {
    const auto & [a, b] = cells.edges[edge];
    edges[edge] = std::min(edges[edge], std::max(times.vertices[a], times.vertices[b]));
  }
  return edges;
}

// Fire that runs along an edge comes to its middle when half its length has burned. An edge that burns sooner after its
// end than this part of its length was burned from the side.
constexpr double kBurnsFromTheSide = 0.28;

/** Times of edges are true to a part of their length only, and along a ribbon narrower than that they rise and fall:
 *  its cross edges then seem to burn before its sides, and it would go from its end on until two lines are left. So
 *  where a face has a free side that is much longer than the edge that burns, meets it, and burns from the side, that
 *  goes with the face. Gives the edge that goes. */
ElementIndex
EdgeThatGoes(const MedialComplex &       surface,
             const std::vector<double> & vertexTimes,
             const std::vector<double> & edgeTimes,
             const EdgeCofaces &         cofaces,
             ElementIndex                edge,
             ElementIndex                face)
{
  const CellComplex & cells = surface.cells;
  const auto          length = [&](ElementIndex of) {
    return Distance(surface.positions[cells.edges[of][0]], surface.positions[cells.edges[of][1]]);
  };
  const auto & ends = cells.edges[edge];
  ElementIndex goes = edge;
  double       longest = -1;
  for (const ElementIndex side : cells.FaceEdges(face))
  {
    if (side == edge || !cofaces.IsFree(side)) // before its ends are fetched: most are not
    {
      continue;
    }
    const auto & [a, b] = cells.edges[side];
    const bool meetsFirst = a == ends[0] || a == ends[1];
    if (!meetsFirst && b != ends[0] && b != ends[1])
    {
      continue;
    }
    longest = longest < 0 ? 2 * length(edge) : longest;
    const double sideLength = length(side);
    if (sideLength > longest && edgeTimes[side] < vertexTimes[meetsFirst ? a : b] + kBurnsFromTheSide * sideLength)
    {
      longest = sideLength;
      goes = side;
    }
  }
  return goes;
}

/** The full collapse, pair by pair: remove(edge, face). */
template <typename TRemove>
void
CollapseInOrder(const MedialComplex &       surface,
                const std::vector<double> & vertexTimes,
                const std::vector<double> & edgeTimes,
                EdgeCofaces &               cofaces,
                const TRemove &             remove)
{
  const CellComplex & cells = surface.cells;
  TimeHeap            heap(FireBucket(surface.radius));
  for (ElementIndex edge = 0; edge < cells.edges.size(); ++edge)
  {
    if (cofaces.IsFree(edge))
    {
      heap.Push({ edgeTimes[edge], edge });
    }
  }
  const auto   due = [&](ElementIndex edge) { return edgeTimes[edge]; };
  TimedElement next;
  // Free edges burn all over the surface in turn: what the next ones need is fetched meanwhile, step by step.
  const auto fetch = [&] {
    if (const ElementIndex edge = heap.Ahead(24); edge != TimeHeap::none)
    {
      cofaces.Fetch(edge);
      FetchLine(&cells.edges[edge]);
    }
    const auto fetchFace = [&](std::size_t steps, auto && what) {
      if (const ElementIndex edge = heap.Ahead(steps); edge != TimeHeap::none && cofaces.IsFree(edge))
      {
        what(cofaces.OnlyFace(edge));
      }
    };
    fetchFace(18, [&](ElementIndex face) { FetchLine(&cells.faceOffsets[face]); });
    fetchFace(14, [&](ElementIndex face) { FetchLine(&cells.faceEdges[cells.faceOffsets[face]]); });
    fetchFace(10, [&](ElementIndex face) {
      for (const ElementIndex side : cells.FaceEdges(face))
      {
        cofaces.Fetch(side);
        FetchLine(&edgeTimes[side]);
      }
    });
    // Lengths are asked for where another side is free, too.
    const auto fetchFree = [&](std::size_t steps, auto && what) {
      fetchFace(steps, [&](ElementIndex face) {
        for (const ElementIndex side : cells.FaceEdges(face))
        {
          if (cofaces.IsFree(side))
          {
            what(side);
          }
        }
      });
    };
    fetchFree(6, [&](ElementIndex side) { FetchLine(&cells.edges[side]); });
    fetchFree(3, [&](ElementIndex side) {
      for (const ElementIndex end : cells.edges[side])
      {
        FetchLine(&surface.positions[end]);
        FetchLine(&vertexTimes[end]);
      }
    });
  };
  while (heap.Pop(due, next))
  {
    fetch();
    const ElementIndex edge = next.element;
    if (!cofaces.IsFree(edge))
    {
      continue; // its face went with another of its edges
    }
    const ElementIndex face = cofaces.OnlyFace(edge);
    remove(EdgeThatGoes(surface, vertexTimes, edgeTimes, cofaces, edge, face), face);
    cofaces.Remove(face);
    for (const ElementIndex side : cells.FaceEdges(face))
    {
      if (cofaces.IsFree(side))
      {
        heap.Push({ edgeTimes[side], side });
      }
    }
  }
}

} // namespace

LiveElements
CollapseSurface(const MedialComplex &       surface,
                const BurnTimes &           times,
                double                      plateThreshold,
                std::vector<std::uint8_t> & closed)
{
  const CellComplex & cells = surface.cells;
  const bool          worthIt = cells.FaceCount() > 10000;
  const bool          hasPlates = plateThreshold < std::numeric_limits<double>::infinity();
  LiveElements        live;
  std::vector<double> edgeTimes;
  EdgeCofaces         cofaces;
  RunBoth(
    worthIt,
    [&] { cofaces = EdgeCofaces(cells); },
    [&] {
      edgeTimes = TimesOfEdges(cells, times);
      live = { std::vector<std::uint8_t>(cells.vertexCount, 1),
               std::vector<std::uint8_t>(cells.edges.size(), 1),
               std::vector<std::uint8_t>(cells.FaceCount(), 1) };
    });
  const auto remove = [&](ElementIndex edge, ElementIndex face) {
    live.faces[face] = 0;
    live.edges[edge] = 0;
  };
  if (!hasPlates)
  {
    CollapseInOrder(surface, times.vertices, edgeTimes, cofaces, remove);
    closed = live.faces;
    return live;
  }
  closed.assign(cells.FaceCount(), 1);
  EdgeCofaces besidePlates = cofaces;
  CollapseInOrder(surface, times.vertices, edgeTimes, cofaces, [&](ElementIndex edge, ElementIndex face) {
    closed[face] = 0;
    const auto corners = cells.FaceVertices(face);
    double     radius = 0;
    for (const ElementIndex corner : corners)
    {
      radius += surface.radius[corner];
    }
    const double thickness = times.faces[face] - radius / static_cast<double>(corners.size());
    if (thickness < plateThreshold && besidePlates.IsFree(edge))
    {
      besidePlates.Remove(face);
      remove(edge, face);
    }
  });
  return live;
}

} // namespace voxelcore
