// What it costs to take an element away, and who keeps what it kept.

#include "ToleranceCollapse.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace voxelcore
{

namespace
{

// How far uphill a keeper is looked for. A spur of noise in a thick part has a hump here and there at which the next
// ball in is no better than it; those further in are.
constexpr int kUphillSteps = 32;

// How many vertices around a loose end are looked at when those uphill will not do.
constexpr std::size_t kAround = 32;

// Fire costs that much more than what sticks out. Sheets stop a little before the balls at their rims are used up, so
// that the loose edges a burnt face leaves behind still find keepers; without it sheets grow hair along their rims.
constexpr double kMargin = 1.25;

} // namespace

void
ToleranceCollapse::Keep(ElementIndex vertex, std::uint32_t point, double gap)
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
ToleranceCollapse::HandOver(ElementIndex from, ElementIndex to, double gap)
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
ToleranceCollapse::FaceCost(ElementIndex edge, std::vector<Reached> & reached) const
{
  const CellComplex & cells = m_Core->cells;
  const ElementIndex  face = m_EdgeStanding[edge].Coface();
  const auto          corners = cells.FaceVertices(face);
  const auto          sides = cells.FaceEdges(face);
  const auto [a, c] = cells.edges[edge];
  const Vertex & atA = m_Vertices[a];
  const Vertex & atC = m_Vertices[c];
  // The witness must not stick out, and neither must the end that fire comes from: else fire that came in along one
  // sheet would run out again along the next one, towards balls beside its witness.
  const bool     ownA = atA.witness == a;
  const bool     ownC = atC.witness == c;
  const Vertex & fireA = m_Vertices[atA.witness];
  const Vertex & fireC = m_Vertices[atC.witness];
  double         cost = std::max(atA.burnt, atC.burnt);
  bool           isFreeBefore = m_EdgeStanding[sides.back()].IsFree();
  reached.clear();
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const bool isFree = m_EdgeStanding[sides[i]].IsFree();
    const bool meets = isFreeBefore || isFree;
    isFreeBefore = isFree;
    const ElementIndex corner = corners[i];
    if (corner == a || corner == c)
    {
      continue;
    }
    const Vertex & w = m_Vertices[corner];
    double         fromA = Protrusion(atA, w);
    double         fromC = Protrusion(atC, w);
    if (!ownA)
    {
      fromA = std::max(fromA, Protrusion(fireA, w));
    }
    if (!ownC)
    {
      fromC = std::max(fromC, Protrusion(fireC, w));
    }
    const double across = std::max(kMargin * std::min(fromA, fromC), w.burnt);
    // Sides i - 1 and i meet at corner i. Where one of them is free, fire comes from there too, and the two meet.
    if (meets)
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
ToleranceCollapse::Uphill(ElementIndex vertex)
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
ToleranceCollapse::CollectKeepers(ElementIndex vertex, ElementIndex other)
{
  m_Keepers.clear();
  // Uphill from both. Where the second way meets the first they are one.
  std::array<ElementIndex, kUphillSteps> way{};
  std::size_t                            length = 0;
  ElementIndex                           at = vertex;
  while (length < kUphillSteps && Uphill(at) != at)
  {
    at = Uphill(at);
    way[length++] = at;
    if (IsLive(at))
    {
      m_Keepers.push_back(at);
    }
  }
  std::size_t same = length; // where on the first way the second is
  at = other;
  if (const auto start = std::find(way.begin(), way.begin() + length, other); start != way.begin() + length)
  {
    same = static_cast<std::size_t>(start - way.begin());
  }
  for (std::size_t step = 0; step < kUphillSteps && Uphill(at) != at; ++step)
  {
    at = Uphill(at);
    same = same < length ? same + 1
                         : static_cast<std::size_t>(std::find(way.begin(), way.begin() + length, at) - way.begin());
    if (same >= length && at != vertex && IsLive(at))
    {
      m_Keepers.push_back(at);
    }
  }
  const auto add = [&](ElementIndex keeper) {
    if (keeper != vertex && IsLive(keeper) && std::find(m_Keepers.begin(), m_Keepers.end(), keeper) == m_Keepers.end())
    {
      m_Keepers.push_back(keeper);
    }
  };
  for (const ElementIndex centre : { vertex, other })
  {
    for (std::uint32_t i = m_Vertices[centre].neighbours; i < m_Vertices[centre + 1].neighbours; ++i)
    {
      add(m_Neighbours[i]);
    }
  }
}

double
ToleranceCollapse::VertexCost(ElementIndex vertex)
{
  const Vertex & loose = m_Vertices[vertex];
  const auto &   ends = m_Core->cells.edges[m_VertexStanding[vertex].Coface()];
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
ToleranceCollapse::FindHomes(ElementIndex vertex)
{
  m_ToHeir = false;
  m_NewHomes.clear();
  CollectKeepers(vertex, m_Heir);
  double              cost = 0;
  const std::uint32_t last = m_Vertices[vertex].lastKept;
  std::uint32_t       point = last;
  const auto          look = [&](const Position & place, Home & home, std::size_t first) {
    for (std::size_t i = first; i < m_Keepers.size() && home.gap > m_Level; ++i)
    {
      const double gap = Gap(place, m_Vertices[m_Keepers[i]]);
      home = gap < home.gap ? Home{ m_Keepers[i], gap } : home;
    }
  };
  do
  {
    point = m_NextKept[point];
    const Position place = PlaceOf(point);
    Home           home{ m_Heir, Gap(place, m_Vertices[m_Heir]) };
    look(place, home, 0);
    m_NewHomes.push_back(home);
    cost = std::max(cost, home.gap);
  } while (point != last);
  // Below a voxel's diagonal that hardly changes anything, and most are.
  if (cost > std::max(m_Level, m_Measured / kMeasured))
  {
    const std::size_t first = m_Keepers.size();
    CollectAround(vertex);
    cost = 0;
    for (Home & home : m_NewHomes)
    {
      point = m_NextKept[point];
      look(PlaceOf(point), home, first);
      cost = std::max(cost, home.gap);
    }
  }
  return cost;
}

// Those around the next vertex, nearest first by number of edges: at the rim of a sheet balls beside the loose end are
// as near as those further in.
void
ToleranceCollapse::CollectAround(ElementIndex vertex)
{
  m_Around.assign(1, m_Heir);
  for (std::size_t i = 0; i < m_Around.size() && m_Around.size() < kAround; ++i)
  {
    const ElementIndex centre = m_Around[i];
    for (std::uint32_t j = m_Vertices[centre].neighbours; j < m_Vertices[centre + 1].neighbours; ++j)
    {
      const ElementIndex other = m_Neighbours[j];
      if (other != vertex && IsLive(other) && std::find(m_Around.begin(), m_Around.end(), other) == m_Around.end())
      {
        m_Around.push_back(other);
      }
    }
  }
  m_Keepers.insert(m_Keepers.end(), m_Around.begin(), m_Around.end());
}

} // namespace voxelcore
