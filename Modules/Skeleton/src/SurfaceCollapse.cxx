#include "SurfaceCollapse.h"

#include "TimeHeap.h"

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
  explicit EdgeCofaces(const CellComplex & cells)
    : m_Cells(cells)
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
    __builtin_prefetch(&m_Cofaces[edge], 1);
  }

  void
  Remove(ElementIndex face)
  {
    for (const ElementIndex edge : m_Cells.FaceEdges(face))
    {
      m_Cofaces[edge].Remove(face);
    }
  }

private:
  const CellComplex &  m_Cells;
  std::vector<Cofaces> m_Cofaces;
};

struct RemovedPair
{
  ElementIndex edge;
  ElementIndex face;
};

/** The full collapse, pair by pair. */
std::vector<RemovedPair>
CollapseOrder(const MedialComplex & surface, const BurnTimes & times)
{
  const CellComplex &      cells = surface.cells;
  EdgeCofaces              cofaces(cells);
  std::vector<RemovedPair> order;
  order.reserve(cells.FaceCount());
  TimeHeap heap(FireBucket(surface.radius));
  for (ElementIndex edge = 0; edge < cells.edges.size(); ++edge)
  {
    if (cofaces.IsFree(edge))
    {
      heap.Push({ times.edges[edge], edge });
    }
  }
  const auto   due = [&](ElementIndex edge) { return times.edges[edge]; };
  TimedElement next;
  // Free edges burn all over the surface in turn: what the next ones need is fetched meanwhile, step by step.
  const auto fetch = [&] {
    if (const ElementIndex edge = heap.Ahead(16); edge != TimeHeap::none)
    {
      cofaces.Fetch(edge);
    }
    const auto fetchFace = [&](std::size_t steps, auto && what) {
      if (const ElementIndex edge = heap.Ahead(steps); edge != TimeHeap::none && cofaces.IsFree(edge))
      {
        what(cofaces.OnlyFace(edge));
      }
    };
    fetchFace(12, [&](ElementIndex face) { __builtin_prefetch(&cells.faceOffsets[face]); });
    fetchFace(8, [&](ElementIndex face) { __builtin_prefetch(&cells.faceEdges[cells.faceOffsets[face]]); });
    fetchFace(4, [&](ElementIndex face) {
      for (const ElementIndex side : cells.FaceEdges(face))
      {
        cofaces.Fetch(side);
        __builtin_prefetch(&times.edges[side]);
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
    cofaces.Remove(face);
    order.push_back({ edge, face });
    for (const ElementIndex side : cells.FaceEdges(face))
    {
      if (side != edge && cofaces.IsFree(side))
      {
        heap.Push({ times.edges[side], side });
      }
    }
  }
  return order;
}

} // namespace

LiveElements
CollapseSurface(const MedialComplex &       surface,
                const BurnTimes &           times,
                double                      plateThreshold,
                std::vector<std::uint8_t> & closed)
{
  const CellComplex &            cells = surface.cells;
  const std::vector<RemovedPair> order = CollapseOrder(surface, times);
  LiveElements                   live{ std::vector<std::uint8_t>(cells.vertexCount, 1),
                     std::vector<std::uint8_t>(cells.edges.size(), 1),
                     std::vector<std::uint8_t>(cells.FaceCount(), 1) };
  const auto                     remove = [&](const RemovedPair & pair) {
    live.faces[pair.face] = 0;
    live.edges[pair.edge] = 0;
  };
  if (plateThreshold == std::numeric_limits<double>::infinity())
  {
    std::for_each(order.begin(), order.end(), remove);
    closed = live.faces;
    return live;
  }
  closed.assign(cells.FaceCount(), 1);
  EdgeCofaces cofaces(cells);
  for (const RemovedPair & pair : order)
  {
    closed[pair.face] = 0;
    const auto corners = cells.FaceVertices(pair.face);
    double     radius = 0;
    for (const ElementIndex corner : corners)
    {
      radius += surface.radius[corner];
    }
    const double thickness = times.faces[pair.face] - radius / static_cast<double>(corners.size());
    if (thickness < plateThreshold && cofaces.IsFree(pair.edge))
    {
      cofaces.Remove(pair.face);
      remove(pair);
    }
  }
  return live;
}

} // namespace voxelcore
