// What it costs to take an element away, and who keeps what it kept.

#include "LooseEnds.h"

#include "voxelcore/Base/Library.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace voxelcore
{

namespace
{

// How far uphill a keeper is looked for. A spur of noise in a thick part has a hump here and there at which the next
// ball in is no better than it; those further in are.
constexpr int kUphillSteps = 32;

// How many vertices around a loose end are looked at when those uphill will not do, and how often at most: each time
// for the boundary vertex that is then the farthest from all balls.
constexpr std::size_t kAround = 24;
constexpr int         kSearches = 4;

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

// Uphill from both, then what is around both; each once.
void
LooseEnds::CollectKeepers(ElementIndex vertex, ElementIndex other)
{
  const auto neighboursOf = [&](ElementIndex of) {
    return std::span(m_Neighbours).subspan(m_FirstNeighbour[of], m_FirstNeighbour[of + 1] - m_FirstNeighbour[of]);
  };
  m_Candidates.Clear();
  m_Candidates.MakeRoom(2 * kUphillSteps + neighboursOf(vertex).size() + neighboursOf(other).size());
  ++m_Look;
  m_Balls[vertex].seen = m_Look;
  m_Balls[other].seen = m_Look;
  const auto add = [&](ElementIndex keeper) {
    std::uint32_t & seen = m_Balls[keeper].seen;
    m_Candidates.AddIf(keeper, IsLive(keeper) & (seen != m_Look));
    seen = m_Look;
  };
  for (const ElementIndex start : { vertex, other })
  {
    ElementIndex at = start;
    for (int step = 0; step < kUphillSteps; ++step)
    {
      const ElementIndex next = Uphill(at);
      if (next == at)
      {
        break;
      }
      at = next;
      add(at);
    }
  }
  ranges::for_each(neighboursOf(vertex), add);
  ranges::for_each(neighboursOf(other), add);
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
  const double     beyond = Protrusion(loose, heir);
  m_HeirGap = loose.bound + (beyond > 0 ? m_LargestWeight * beyond : beyond); // no weight is less than 1
  if (m_HeirGap <= m_Height || m_Height > m_Levels.Measured())
  {
    return m_HeirGap;
  }
  const std::uint32_t before = FarthestKept(loose.lastKept, heir);
  if (m_HeirGap <= m_Height)
  {
    return m_HeirGap;
  }
  m_Balls[vertex].lastKept = before; // the farthest comes first
  return FindHomes(vertex);
}

// The one before, in the ring, that which lies farthest from its heir.
std::uint32_t
LooseEnds::FarthestKept(std::uint32_t last, const CoreBall & heir)
{
  double        farthest = m_Weights.empty() ? 0 : -HUGE_VAL;
  std::uint32_t before = last;
  std::uint32_t point = last;
  do
  {
    const std::uint32_t next = m_NextKept[point];
    const WeighedPlace  place = PlaceOf(next);
    const double        far = m_Weights.empty() ? SquaredDistance(place.place, heir.centre) : Gap(place, heir);
    if (far > farthest)
    {
      farthest = far;
      before = point;
    }
    point = next;
  } while (point != last);
  m_HeirGap = m_Weights.empty() ? std::sqrt(farthest) - heir.radius : farthest;
  return before;
}

double
LooseEnds::OfferHome(Home & home, const WeighedPlace & place, ElementIndex vertex) const
{
  const double gap = Gap(place, m_Balls[vertex]);
  if (gap < home.gap)
  {
    home.vertex = vertex;
    home.gap = gap;
  }
  return gap;
}

double
LooseEnds::FindHomes(ElementIndex vertex)
{
  m_ToHeir = false;
  m_NewHomes.clear();
  CollectKeepers(vertex, m_Heir);
  const std::uint32_t last = m_Balls[vertex].lastKept;
  std::uint32_t       point = last;
  do
  {
    point = m_NextKept[point];
    m_NewHomes.push_back({ m_Heir, 0, Gap(PlaceOf(point), m_Balls[m_Heir]) });
  } while (point != last);
  Farthest farthest = OfferCandidates(last);
  bool     isNear = true;
  // Below a voxel's diagonal a search hardly changes anything, and most are.
  for (int i = 0; i < kSearches && isNear && farthest.gap > std::max(m_Height, m_Levels.Diagonal()); ++i)
  {
    Home & home = m_NewHomes[farthest.home];
    SearchAround(vertex, farthest.place, home);
    isNear = home.gap <= m_Height;
    farthest = OfferCandidates(last);
  }
  return farthest.gap;
}

// What is kept, from the one after `last` on, is offered the candidates. Beyond the height nothing counts but what is
// farthest, and a ball as near as that will do for all others.
LooseEnds::Farthest
LooseEnds::OfferCandidates(std::uint32_t last)
{
  Farthest      farthest{ 0, 0, {} };
  std::uint32_t point = last;
  for (std::size_t i = 0; i < m_NewHomes.size(); ++i)
  {
    point = m_NextKept[point];
    Home &       home = m_NewHomes[i];
    const double enough = std::max(m_Height, farthest.gap);
    if (home.gap > farthest.gap)
    {
      const WeighedPlace place = PlaceOf(point);
      while (home.gap > enough && home.next < m_Candidates.Count())
      {
        OfferHome(home, place, m_Candidates[home.next++]);
      }
      if (home.gap > farthest.gap)
      {
        farthest = { home.gap, i, place };
      }
    }
  }
  return farthest;
}

// Adds candidates around the next vertex until one is near enough to a place that none is yet, always on from the
// nearest to it so far: at the rim of a sheet balls beside the loose end are as near as those further in.
void
LooseEnds::SearchAround(ElementIndex vertex, const WeighedPlace & place, Home & home)
{
  const auto isFarther = [](const Near & a, const Near & b) {
    return a.gap != b.gap ? a.gap > b.gap : a.vertex > b.vertex;
  };
  ++m_Look;
  m_Balls[vertex].seen = m_Look;
  m_Balls[m_Heir].seen = m_Look;
  m_Around.assign(1, { 0, m_Heir });
  for (std::size_t count = 1; count < kAround && !m_Around.empty() && home.gap > m_Height;)
  {
    ranges::pop_heap(m_Around, isFarther);
    const ElementIndex centre = m_Around.back().vertex;
    m_Around.pop_back();
    const std::uint32_t end = m_FirstNeighbour[centre + 1];
    m_Candidates.MakeRoom(end - m_FirstNeighbour[centre]);
    for (std::uint32_t i = m_FirstNeighbour[centre]; i < end; ++i)
    {
      const ElementIndex other = m_Neighbours[i];
      if (m_Balls[other].seen != m_Look && IsLive(other))
      {
        m_Candidates.AddIf(other, m_Balls[other].seen != m_Look - 1);
        m_Balls[other].seen = m_Look;
        m_Around.push_back({ OfferHome(home, place, other), other });
        ranges::push_heap(m_Around, isFarther);
        ++count;
      }
    }
  }
  home.next = static_cast<std::uint32_t>(m_Candidates.Count());
}

} // namespace voxelcore
