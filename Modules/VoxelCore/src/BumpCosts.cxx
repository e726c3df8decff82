// What it costs to take an element away, and who keeps what it kept.

#include "BumpCollapse.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{

namespace
{

// How far uphill a keeper is looked for. A spur of noise in a thick part has a hump here and there at which the next
// ball in is no better than it; those further in are.
constexpr int kUphillSteps = 32;

// Fire costs that much more than what sticks out. Sheets stop a little before the balls at their rims are used up, so
// that the loose edges a burnt face leaves behind still find keepers; without it sheets grow hair along their rims.
constexpr double kMargin = 1.25;

} // namespace

void
BumpCollapse::Keep(ElementIndex vertex, std::uint32_t point, double gap)
{
  Vertex & keeper = m_Vertices[vertex];
  if (keeper.lastKept == kNone)
  {
    m_NextKept[point] = point;
  }
  else
  {
    m_NextKept[point] = m_NextKept[keeper.lastKept];
    m_NextKept[keeper.lastKept] = point;
  }
  keeper.lastKept = point;
  keeper.bound = std::max(keeper.bound, gap);
}

void
BumpCollapse::HandOver(ElementIndex from, ElementIndex to, double gap)
{
  const std::uint32_t last = m_Vertices[from].lastKept;
  if (last == kNone)
  {
    return;
  }
  Vertex & keeper = m_Vertices[to];
  if (keeper.lastKept != kNone)
  {
    std::swap(m_NextKept[last], m_NextKept[keeper.lastKept]); // two rings become one
  }
  keeper.lastKept = last;
  keeper.bound = std::max(keeper.bound, gap);
}

double
BumpCollapse::FaceCost(ElementIndex edge, std::vector<Reached> & reached) const
{
  const CellComplex & cells = m_Core->cells;
  const ElementIndex  face = m_EdgeCofaces[edge].exclusiveOr;
  const auto          corners = cells.FaceVertices(face);
  const auto          sides = cells.FaceEdges(face);
  const auto [a, c] = cells.edges[edge];
  const Vertex & atA = m_Vertices[a];
  const Vertex & atC = m_Vertices[c];
  // The witness must not stick out, and neither must the end that fire comes from: else fire that came in along one
  // sheet would run out again along the next one, towards balls beside its witness.
  const auto sticksOut = [this](ElementIndex end, const Vertex & at, const Vertex & w) {
    const double own = Protrusion(at, w);
    return at.witness == end ? own : std::max(own, Protrusion(m_Vertices[at.witness], w));
  };
  double cost = std::max(atA.burnt, atC.burnt);
  reached.clear();
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const ElementIndex corner = corners[i];
    if (corner == a || corner == c)
    {
      continue;
    }
    const Vertex & w = m_Vertices[corner];
    const double   fromA = sticksOut(a, atA, w);
    const double   fromC = sticksOut(c, atC, w);
    const double   across = std::max(kMargin * std::min(fromA, fromC), w.burnt);
    // Sides i - 1 and i meet at corner i. Where one of them is free, fire comes from there too, and the two meet.
    const ElementIndex before = sides[i == 0 ? sides.size() - 1 : i - 1];
    if (m_EdgeCofaces[before].count == 1 || m_EdgeCofaces[sides[i]].count == 1)
    {
      cost = std::max(cost, (w.burnt + across) / 2);
    }
    else
    {
      cost = std::max(cost, across);
      reached.push_back({ corner, fromC < fromA ? atC.witness : atA.witness, across });
    }
  }
  return cost;
}

ElementIndex
BumpCollapse::Uphill(ElementIndex vertex)
{
  Vertex & from = m_Vertices[vertex];
  if (from.uphill == kNone)
  {
    from.uphill = vertex;
    double steepest = 0;
    for (std::uint32_t i = from.neighbours; i < m_Vertices[vertex + 1].neighbours; ++i)
    {
      const ElementIndex other = m_Neighbours[i];
      const double       rise = m_Vertices[other].radius - from.radius;
      if (rise <= 0)
      {
        continue;
      }
      // Protrusion is distance minus rise.
      const double slope = rise / (Protrusion(from, m_Vertices[other]) + rise);
      if (slope > steepest)
      {
        steepest = slope;
        from.uphill = other;
      }
    }
  }
  return from.uphill;
}

void
BumpCollapse::CollectKeepers(ElementIndex vertex, ElementIndex other)
{
  const auto add = [&](ElementIndex keeper) {
    if (keeper != vertex && IsLive(keeper) && std::find(m_Keepers.begin(), m_Keepers.end(), keeper) == m_Keepers.end())
    {
      m_Keepers.push_back(keeper);
    }
  };
  m_Keepers.clear();
  for (const ElementIndex start : { vertex, other })
  {
    ElementIndex at = start;
    for (int step = 0; step < kUphillSteps && Uphill(at) != at; ++step)
    {
      at = Uphill(at);
      add(at);
    }
  }
  for (const ElementIndex centre : { vertex, other })
  {
    for (std::uint32_t i = m_Vertices[centre].neighbours; i < m_Vertices[centre + 1].neighbours; ++i)
    {
      add(m_Neighbours[i]);
    }
  }
}

double
BumpCollapse::VertexCost(ElementIndex vertex)
{
  const Vertex & loose = m_Vertices[vertex];
  const auto &   ends = m_Core->cells.edges[m_VertexCofaces[vertex].exclusiveOr];
  m_Heir = ends[0] == vertex ? ends[1] : ends[0];
  m_ToHeir = true;
  m_HeirGap = 0;
  if (loose.lastKept == kNone)
  {
    return 0;
  }
  // Mostly the next vertex of the edge will do, and mostly that is seen without a look at what is kept.
  const Vertex & heir = m_Vertices[m_Heir];
  m_HeirGap = loose.bound + Protrusion(loose, heir);
  if (m_HeirGap <= m_Level || m_Level > m_Measured)
  {
    return m_HeirGap;
  }
  double        farthest = 0;
  std::uint32_t point = loose.lastKept;
  do
  {
    point = m_NextKept[point];
    farthest = std::max(farthest, SquaredDistance(PlaceOf(point), heir.centre));
  } while (point != loose.lastKept);
  m_HeirGap = std::sqrt(farthest) - heir.radius;
  return m_HeirGap <= m_Level ? m_HeirGap : FindHomes(vertex);
}

double
BumpCollapse::FindHomes(ElementIndex vertex)
{
  m_ToHeir = false;
  m_NewHomes.clear();
  CollectKeepers(vertex, m_Heir);
  double              cost = 0;
  const std::uint32_t last = m_Vertices[vertex].lastKept;
  std::uint32_t       point = last;
  do
  {
    point = m_NextKept[point];
    Home home{ m_Heir, Gap(point, m_Vertices[m_Heir]) };
    for (std::size_t i = 0; i < m_Keepers.size() && home.gap > m_Level; ++i)
    {
      const double gap = Gap(point, m_Vertices[m_Keepers[i]]);
      home = gap < home.gap ? Home{ m_Keepers[i], gap } : home;
    }
    m_NewHomes.push_back(home);
    cost = std::max(cost, home.gap);
  } while (point != last);
  return cost;
}

} // namespace voxelcore
