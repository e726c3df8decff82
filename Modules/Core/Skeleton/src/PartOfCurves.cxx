#include "PartOfCurves.h"

#include "voxelcore/Base/UnionFind.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <tuple>

namespace voxelcore
{

namespace
{

/** Points in order of their component, then of x. */
class PointsInOrder
{
public:
  PointsInOrder(const std::vector<Vector3> &       places,
                const std::vector<std::uint32_t> & components,
                const std::vector<std::uint8_t> &  taken)
    : m_Places(places)
    , m_Components(components)
  {
    for (ElementIndex point = 0; point < places.size(); ++point)
    {
      if (taken[point])
      {
        m_Order.push_back(point);
      }
    }
    std::sort(m_Order.begin(), m_Order.end(), [&](ElementIndex a, ElementIndex b) {
      return std::tie(components[a], places[a][0], a) < std::tie(components[b], places[b][0], b);
    });
  }

  /** The point of the tip's component that is nearest to it, of equals the smallest; kNoEdge where there is none. */
  ElementIndex
  Nearest(const TipPlace & tip) const
  {
    ElementIndex nearest = kNoEdge;
    double       least = std::numeric_limits<double>::infinity();
    const auto   look = [&](ElementIndex point) {
      if (m_Components[point] != tip.component || std::abs(m_Places[point][0] - tip.place[0]) > least)
      {
        return false;
      }
      const double away = Distance(m_Places[point], tip.place);
      if (away < least || (away == least && point < nearest))
      {
        least = away;
        nearest = point;
      }
      return true;
    };
    const auto middle = std::lower_bound(m_Order.begin(), m_Order.end(), tip, [&](ElementIndex a, const TipPlace & b) {
      return std::tie(m_Components[a], m_Places[a][0]) < std::tie(b.component, b.place[0]);
    });
    std::find_if_not(middle, m_Order.end(), look);
    std::find_if_not(std::make_reverse_iterator(middle), m_Order.rend(), look);
    return nearest;
  }

private:
  const std::vector<Vector3> &       m_Places;
  const std::vector<std::uint32_t> & m_Components;
  std::vector<ElementIndex>          m_Order;
};

} // namespace

std::vector<std::uint32_t>
ComponentOfVertices(const CellComplex & cells)
{
  UnionFind pieces(cells.vertexCount);
  for (const auto & [a, b] : cells.edges)
  {
    pieces.Unite(a, b);
  }
  std::vector<std::uint32_t> components(cells.vertexCount);
  for (std::size_t vertex = 0; vertex < components.size(); ++vertex)
  {
    components[vertex] = pieces.Find(vertex);
  }
  return components;
}

void
KeepPart(const LiveElements & part, TurnedSurface & turned, BurnTimes & times, std::vector<std::uint32_t> & components)
{
  const auto turn = [&](const std::vector<std::uint8_t> & live, const std::vector<ElementIndex> & places) {
    std::vector<std::uint8_t> result(live.size());
    std::transform(places.begin(), places.end(), result.begin(), [&](ElementIndex place) { return live[place]; });
    return result;
  };
  const LiveElements live{ turn(part.vertices, turned.vertices),
                           turn(part.edges, turned.edges),
                           turn(part.faces, turned.faces) };
  PartElements       kept;
  turned.surface.cells = ExtractLive(turned.surface.cells, live, kept.vertices, kept.edges, kept.faces);
  const auto gather = [](const std::vector<ElementIndex> & ids, auto &... arrays) {
    const auto one = [&](auto & values) {
      for (std::size_t i = 0; i < ids.size(); ++i)
      {
        values[i] = values[ids[i]]; // ids ascend
      }
      values.resize(ids.size());
    };
    (one(arrays), ...);
  };
  gather(kept.vertices, turned.surface.positions, turned.surface.radius, turned.vertices, times.vertices, components);
  gather(kept.edges, turned.edges, times.edges);
  gather(kept.faces, turned.faces, turned.starts, times.faces);
}

void
KeepWaysBetween(const std::vector<TipPlace> &      tips,
                const MedialComplex &              surface,
                const std::vector<std::uint32_t> & components,
                const CurveFire &                  fire,
                LiveElements &                     live)
{
  const CellComplex &       cells = surface.cells;
  std::vector<std::uint8_t> stays(cells.vertexCount, 0);
  const PointsInOrder       points(surface.positions, components, live.vertices);
  for (const TipPlace & tip : tips)
  {
    if (const ElementIndex nearest = points.Nearest(tip); nearest != kNoEdge)
    {
      stays[nearest] = 1;
    }
  }
  std::vector<Cofaces> degrees(cells.vertexCount);
  for (ElementIndex edge = 0; edge < cells.edges.size(); ++edge)
  {
    if (live.edges[edge])
    {
      degrees[cells.edges[edge][0]].Add(edge);
      degrees[cells.edges[edge][1]].Add(edge);
    }
  }
  const auto takeOff = [&](ElementIndex vertex) {
    if (degrees[vertex].count == 1 && !stays[vertex])
    {
      const ElementIndex edge = degrees[vertex].exclusiveOr;
      live.vertices[vertex] = 0;
      live.edges[edge] = 0;
      degrees[cells.edges[edge][0] ^ cells.edges[edge][1] ^ vertex].Remove(edge);
      degrees[vertex].Remove(edge);
    }
  };
  // Fire goes from all ends inwards; where it ended may be an end itself by then.
  std::for_each(fire.order.begin(), fire.order.end(), takeOff);
  std::for_each(fire.order.rbegin(), fire.order.rend(), takeOff);
}

} // namespace voxelcore
