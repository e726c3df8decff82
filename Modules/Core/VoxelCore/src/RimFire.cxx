#include "RimFire.h"

#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Base/Prefetch.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

namespace voxelcore
{

namespace
{

// Fire costs that much more than what sticks out. Sheets stop a little before the balls at their rims are used up, so
// that the loose edges a burnt face leaves behind still find keepers; without it sheets grow hair along their rims.
constexpr double kMargin = 1.25;

constexpr std::size_t kCachedBalls = std::size_t{ 1 } << 14; // so many stay in the cache with what is asked around them

constexpr std::size_t kChunk = std::size_t{ 1 } << 16; // what is computed side by side waits here for its turn

// Levels of faces that have not burnt.
constexpr std::uint16_t kThere = 0xFFFF;
constexpr std::uint16_t kFloorTookIt = 0xFFFE;

} // namespace

void
RimFire::FetchFace(std::uint32_t place) const
{
  for (const ElementIndex edge : EdgesAt(place))
  {
    FetchLine(&m_Edges[edge]);
  }
  for (const ElementIndex vertex : VerticesAt(place))
  {
    FetchLine(&m_Balls[vertex]);
  }
}

void
RimFire::FetchAhead(std::size_t at) const
{
  // Waves jump about in memory: what the edges ahead will ask for is fetched step by step.
  const auto ahead = [&](std::size_t by) -> const RemainingElements * {
    return at + by < m_Open.size() && m_Edges[m_Open[at + by]].IsFree() ? &m_Edges[m_Open[at + by]] : nullptr;
  };
  if (at + 32 < m_Open.size())
  {
    FetchLine(&m_Edges[m_Open[at + 32]]);
  }
  if (const RemainingElements * edge = ahead(24))
  {
    FetchLine(&m_Faces[edge->Coface()]);
    FetchLine(&m_Cells.faceVertices[edge->Coface()]);
    FetchLine(&m_Cells.faceEdges[edge->Coface()]);
  }
  if (const RemainingElements * edge = ahead(14))
  {
    FetchFace(edge->Coface());
  }
  if (const RemainingElements * edge = ahead(6))
  {
    const auto corners = VerticesAt(edge->Coface());
    const auto here = static_cast<std::size_t>(edge->Side());
    FetchLine(&m_Balls[m_Balls[corners[here]].witness]);
    FetchLine(&m_Balls[m_Balls[corners[here + 1 == corners.size() ? 0 : here + 1]].witness]);
  }
}

RimFire::RimFire(const CellComplex &     cells,
                 const LiveElements &    left,
                 const ToleranceLevels & levels,
                 const TouchedPlaces &   touched,
                 std::vector<CoreBall> & balls)
  : m_Cells(cells)
  , m_Levels(levels)
  , m_Touched(touched)
  , m_Balls(balls)
  , m_FetchesAhead(balls.size() > kCachedBalls)
  , m_Edges(cells.edges.size())
  , m_Turns(levels.Count())
{
  m_Burnt.reserve(cells.FaceCount());
  GatherFaces(left);
  OfferAll();
}

void
RimFire::GatherFaces(const LiveElements & left)
{
  if (m_Cells.faceEdges.size() > std::numeric_limits<std::uint32_t>::max() || m_Levels.Count() > kFloorTookIt)
  {
    throw std::length_error("a core of so many faces cannot be pruned by tolerance");
  }
  m_Faces.resize(m_Cells.faceEdges.size());
  for (std::size_t edge = 0; edge < left.edges.size(); ++edge)
  {
    if (left.edges[edge] == 0)
    {
      m_Edges[edge].Go(kBelowFloor);
    }
  }
  for (std::size_t face = 0; face < m_Cells.FaceCount(); ++face)
  {
    const auto place = static_cast<std::uint32_t>(m_Cells.faceOffsets[face]);
    const auto edges = m_Cells.FaceEdges(face);
    const bool isLeft = left.faces.empty() || left.faces[face] != 0;
    m_Faces[place] = isLeft ? kThere : kFloorTookIt;
    m_Faces[place + 1] = static_cast<Word>(edges.size());
    if (isLeft)
    {
      for (std::size_t side = 0; side < edges.size(); ++side)
      {
        m_Edges[edges[side]].Add(place, side);
      }
    }
  }
  for (const RemainingElements & edge : m_Edges)
  {
    if (edge.IsFree())
    {
      NoteFree(edge);
    }
  }
}

void
RimFire::OfferAll()
{
  std::vector<double> costs(std::min(m_Edges.size(), kChunk));
  for (std::size_t first = 0; first < m_Edges.size(); first += kChunk)
  {
    const std::size_t last = std::min(m_Edges.size(), first + kChunk);
    FirstFailure      failure;
#pragma omp parallel if (last - first > 4096)
    {
      ReachedVertices reached;
#pragma omp for schedule(static)
      for (std::size_t edge = first; edge < last; ++edge)
      {
        if (const std::size_t ahead = edge + 12; m_FetchesAhead && ahead < m_Edges.size() && m_Edges[ahead].IsFree())
        {
          FetchFace(m_Edges[ahead].Coface());
        }
        if (m_Edges[edge].IsFree())
        {
          failure.Guard(edge, [&] { costs[edge - first] = CostOf(static_cast<ElementIndex>(edge), reached); });
        }
      }
    }
    failure.Rethrow();
    for (std::size_t edge = first; edge < last; ++edge)
    {
      if (m_Edges[edge].IsFree())
      {
        Wait(static_cast<ElementIndex>(edge), costs[edge - first]);
      }
    }
  }
}

// Which corners lie between two sides of which one is free, by bits.
std::uint64_t
RimFire::MeetingCorners(std::uint32_t place, std::size_t count) const
{
  const std::uint64_t free = m_Faces[place + 2];
  return free | free << 1U | free >> (count - 1);
}

// Of what the witness and the end that fire comes from touch, for each of two ends. Of the greater of the two it is
// enough to know that it is.
TwoLengths
RimFire::WorstGaps(ElementIndex a, ElementIndex c, const CoreBall & y) const
{
  const ElementIndex witnessA = m_Balls[a].witness;
  const ElementIndex witnessC = m_Balls[c].witness;
  // Mostly the witness, farther out, decides, which is seen by how far the end sticks out.
  const auto withEnd = [&](double gap, ElementIndex end, double enough) {
    const double out = Protrusion(m_Balls[end], y);
    const bool   decides = m_Balls[end].witness == end || gap >= enough ||
                         (out > 0 ? m_Touched.largestWeight * out : out) <= gap; // no weight is less than 1
    return decides ? gap : std::max(gap, m_Touched.WorstGap(end, y, enough));
  };
  const double fromA = m_Touched.WorstGap(witnessA, y, HUGE_VAL);
  const double worstA = withEnd(fromA, a, HUGE_VAL);
  const double fromC = witnessC == witnessA ? fromA : m_Touched.WorstGap(witnessC, y, worstA);
  return TwoLengths{ worstA, withEnd(fromC, c, worstA) };
}

// When fire that comes over a free edge has crossed its face.
double
RimFire::CostOf(ElementIndex edge, ReachedVertices & reached) const
{
  const std::uint32_t place = m_Edges[edge].Coface();
  const auto          here = static_cast<std::size_t>(m_Edges[edge].Side());
  const auto          corners = VerticesAt(place);
  const std::size_t   count = corners.size();
  const auto [a, c] = std::minmax(corners[here], corners[here + 1 == count ? 0 : here + 1]);
  const CoreBall & atA = m_Balls[a];
  const CoreBall & atC = m_Balls[c];
  // The witness must not stick out, and neither must the end that fire comes from: else fire that came in along one
  // sheet would run out again along the next one, towards balls beside its witness.
  const TwoBalls ends(atA, atC);
  const TwoBalls witnesses(m_Balls[atA.witness], m_Balls[atC.witness]);
  // The edge before a corner and that after it meet there. Where one of them is free, fire comes from there, too, and
  // the two meet.
  const bool          areNoted = count <= kNoted;
  const std::uint64_t meeting = areNoted ? MeetingCorners(place, count) : 0;
  double              cost = std::max(atA.burnt, atC.burnt);
  if (reached.list.size() < count)
  {
    reached.list.resize(count);
  }
  reached.count = 0;
  std::size_t i = here + 1 == count ? 0 : here + 1;
  for (std::size_t others = count - 2; others > 0; --others)
  {
    const std::size_t before = i;
    i = i + 1 == count ? 0 : i + 1;
    const CoreBall & w = m_Balls[corners[i]];
    const TwoLengths from =
      m_Touched.AreWeighed() ? WorstGaps(a, c, w) : Larger(Protrusions(ends, w), Protrusions(witnesses, w));
    const double across = std::max(kMargin * std::min(from[0], from[1]), w.burnt);
    const bool   meets = areNoted ? (meeting >> i & 1U) != 0 : IsSideFree(place, before) || IsSideFree(place, i);
    cost = std::max(cost, meets ? (w.burnt + across) / 2 : across);
    reached.list[reached.count] = { corners[i], from[1] < from[0] ? atC.witness : atA.witness, across };
    reached.count += meets ? 0 : 1;
  }
  return cost;
}

// Of the free edges of a face the one that lies nearest to where fire set out, so that what is left of a narrow sheet
// runs along its middle. The time of fire and the radius are, together, how far it has come and the radius at its rim.
std::size_t
RimFire::OuterFreeSide(std::uint32_t place, std::size_t side) const
{
  const auto        corners = VerticesAt(place);
  const std::size_t count = corners.size();
  const auto        depth = [&](std::size_t i) {
    const CoreBall & a = m_Balls[corners[i]];
    const CoreBall & c = m_Balls[corners[i + 1 == count ? 0 : i + 1]];
    return (a.radius + c.radius) + (a.burnt + c.burnt) / kMargin;
  };
  double least = depth(side);
  for (std::size_t i = 0; i < count; ++i)
  {
    if (IsSideFree(place, i))
    {
      const double other = depth(i);
      side = other < least ? i : side;
      least = std::min(least, other);
    }
  }
  return side;
}

void
RimFire::Remove(ElementIndex edge, std::size_t level)
{
  const std::uint32_t place = m_Edges[edge].Coface();
  edge = m_Cells.faceEdges[place + OuterFreeSide(place, m_Edges[edge].Side())];
  for (std::size_t i = 0; i < m_Reached.count; ++i)
  {
    const Reached & reached = m_Reached.list[i];
    m_Balls[reached.vertex].burnt = reached.time;
    m_Balls[reached.vertex].witness = reached.witness;
  }
  m_Faces[place] = static_cast<Word>(level);
  const auto sides = EdgesAt(place);
  for (std::size_t i = 0; i < sides.size(); ++i)
  {
    RemainingElements & side = m_Edges[sides[i]];
    side.Remove(place, i);
    if (sides[i] != edge && side.IsFree())
    {
      NoteFree(side);
      m_Open.push_back(sides[i]);
    }
  }
  m_Edges[edge].Go(m_Levels.Height(level));
  m_Burnt.push_back(edge);
}

void
RimFire::Burn(std::size_t level)
{
  const double height = m_Levels.Height(level);
  m_Open = std::move(m_Turns[level]); // what the last level had is given back
  m_Waiting -= m_Open.size();
  for (std::size_t at = 0; at < m_Open.size(); ++at)
  {
    if (m_FetchesAhead)
    {
      FetchAhead(at);
    }
    const ElementIndex edge = m_Open[at];
    if (!m_Edges[edge].IsFree())
    {
      continue;
    }
    // Fire may have come from elsewhere since.
    const double cost = CostOf(edge, m_Reached);
    if (cost <= height)
    {
      Remove(edge, level);
    }
    else
    {
      Wait(edge, cost);
    }
  }
}

void
RimFire::KeepLevelsOnly()
{
  for (std::size_t face = 0; face < m_Cells.FaceCount(); ++face)
  {
    m_Faces[face] = m_Faces[m_Cells.faceOffsets[face]]; // no face has fewer than two places
  }
  m_Faces.resize(m_Cells.FaceCount());
  m_Faces.shrink_to_fit();
  std::vector<ElementIndex>().swap(m_Open);
  std::vector<std::vector<ElementIndex>>().swap(m_Turns);
}

std::vector<double>
RimFire::TakeFaceHeights()
{
  std::vector<double> heights(m_Cells.FaceCount());
  RunInParts(heights.size() > 10000, heights.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t face = first; face < last; ++face)
    {
      const Word level = m_Faces[face];
      heights[face] = level == kThere         ? std::numeric_limits<double>::infinity()
                      : level == kFloorTookIt ? kBelowFloor
                                              : m_Levels.Height(level);
    }
  });
  std::vector<Word>().swap(m_Faces);
  return heights;
}

std::vector<double>
RimFire::TakeEdgeHeights()
{
  std::vector<double> heights = HeightsOf(m_Edges);
  std::vector<RemainingElements>().swap(m_Edges);
  return heights;
}

} // namespace voxelcore
