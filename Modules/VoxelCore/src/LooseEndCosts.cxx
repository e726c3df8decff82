// What it costs to take an element away, and who keeps what it kept.

#include "LooseEnds.h"

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

} // namespace

void
LooseEnds::Keep(ElementIndex vertex, std::uint32_t point, double gap)
{
  CoreBall & keeper = m_Balls[vertex];
  if (keeper.lastKept == kNobody)
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
LooseEnds::HandOver(ElementIndex from, ElementIndex to, double gap)
{
  const std::uint32_t last = m_Balls[from].lastKept;
  if (last == kNobody)
  {
    return;
  }
  CoreBall & keeper = m_Balls[to];
  if (keeper.lastKept != kNobody)
  {
    std::swap(m_NextKept[last], m_NextKept[keeper.lastKept]); // two rings become one
  }
  keeper.lastKept = last;
  keeper.bound = std::max(keeper.bound, gap);
}

ElementIndex
LooseEnds::Uphill(ElementIndex vertex)
{
  CoreBall & from = m_Balls[vertex];
  if (from.uphill == kNobody)
  {
    from.uphill = vertex;
    double steepest = 0;
    for (std::uint32_t i = m_FirstNeighbour[vertex]; i < m_FirstNeighbour[vertex + 1]; ++i)
    {
      const ElementIndex other = m_Neighbours[i];
      const double       rise = m_Balls[other].radius - from.radius;
      if (rise <= 0)
      {
        continue;
      }
      // Protrusion is distance minus rise.
      const double slope = rise / (Protrusion(from, m_Balls[other]) + rise);
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
LooseEnds::CollectKeepers(ElementIndex vertex, ElementIndex other)
{
  m_Candidates.clear();
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
      m_Candidates.push_back(at);
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
      m_Candidates.push_back(at);
    }
  }
  const auto add = [&](ElementIndex keeper) {
    if (keeper != vertex && IsLive(keeper) &&
        std::find(m_Candidates.begin(), m_Candidates.end(), keeper) == m_Candidates.end())
    {
      m_Candidates.push_back(keeper);
    }
  };
  for (const ElementIndex centre : { vertex, other })
  {
    for (std::uint32_t i = m_FirstNeighbour[centre]; i < m_FirstNeighbour[centre + 1]; ++i)
    {
      add(m_Neighbours[i]);
    }
  }
}

double
LooseEnds::CostOf(ElementIndex vertex)
{
  const CoreBall & loose = m_Balls[vertex];
  const auto &     ends = m_Cells.edges[m_Standing[vertex].Coface()];
  m_Heir = ends[0] == vertex ? ends[1] : ends[0];
  m_ToHeir = true;
  m_HeirGap = 0;
  if (loose.lastKept == kNobody)
  {
    return 0;
  }
  // Mostly the next vertex of the edge will do, and mostly that is seen without a look at what is kept.
  const CoreBall & heir = m_Balls[m_Heir];
  m_HeirGap = loose.bound + Protrusion(loose, heir);
  if (m_HeirGap <= m_Height || m_Height > m_Levels.Measured())
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
  return m_HeirGap <= m_Height ? m_HeirGap : FindHomes(vertex);
}

double
LooseEnds::FindHomes(ElementIndex vertex)
{
  m_ToHeir = false;
  m_NewHomes.clear();
  CollectKeepers(vertex, m_Heir);
  double              cost = 0;
  const std::uint32_t last = m_Balls[vertex].lastKept;
  std::uint32_t       point = last;
  const auto          look = [&](const BallCentre & place, Home & home, std::size_t first) {
    for (std::size_t i = first; i < m_Candidates.size() && home.gap > m_Height; ++i)
    {
      const double gap = Gap(place, m_Balls[m_Candidates[i]]);
      home = gap < home.gap ? Home{ m_Candidates[i], gap } : home;
    }
  };
  do
  {
    point = m_NextKept[point];
    const BallCentre place = PlaceOf(point);
    Home             home{ m_Heir, Gap(place, m_Balls[m_Heir]) };
    look(place, home, 0);
    m_NewHomes.push_back(home);
    cost = std::max(cost, home.gap);
  } while (point != last);
  // Below a voxel's diagonal that hardly changes anything, and most are.
  if (cost > std::max(m_Height, m_Levels.Diagonal()))
  {
    const std::size_t first = m_Candidates.size();
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
LooseEnds::CollectAround(ElementIndex vertex)
{
  m_Around.assign(1, m_Heir);
  m_Balls[m_Heir].seen = ++m_Look;
  m_Balls[vertex].seen = m_Look;
  for (std::size_t i = 0; i < m_Around.size() && m_Around.size() < kAround; ++i)
  {
    const ElementIndex centre = m_Around[i];
    for (std::uint32_t j = m_FirstNeighbour[centre]; j < m_FirstNeighbour[centre + 1]; ++j)
    {
      const ElementIndex other = m_Neighbours[j];
      if (m_Balls[other].seen != m_Look && IsLive(other))
      {
        m_Balls[other].seen = m_Look;
        m_Around.push_back(other);
      }
    }
  }
  m_Candidates.insert(m_Candidates.end(), m_Around.begin(), m_Around.end());
}

} // namespace voxelcore
