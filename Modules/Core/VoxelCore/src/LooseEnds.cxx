#include "LooseEnds.h"

#include "voxelcore/Base/Prefetch.h"

#include <algorithm>

namespace voxelcore
{

LooseEnds::LooseEnds(const CellComplex &               cells,
                     const LiveElements &              left,
                     const std::vector<LatticePoint> & points,
                     const BallCentre &                scale,
                     const std::vector<double> &       weights,
                     const std::vector<ElementIndex> & largest,
                     const ToleranceLevels &           levels,
                     std::vector<CoreBall> &           balls)
  : m_Cells(cells)
  , m_Points(points)
  , m_Scale(scale)
  , m_Weights(weights)
  , m_Levels(levels)
  , m_Balls(balls)
  , m_Standing(cells.vertexCount)
  , m_NextKept(points.size())
  , m_Turns(levels.Count())
{
  for (const double weight : weights)
  {
    m_LargestWeight = std::max(m_LargestWeight, weight);
  }
  for (std::size_t vertex = 0; vertex < left.vertices.size(); ++vertex)
  {
    if (left.vertices[vertex] == 0)
    {
      m_Standing[vertex].Go(kBelowFloor);
    }
  }
  for (std::uint32_t point = 0; point < points.size(); ++point)
  {
    const ElementIndex ball = largest[point];
    if (IsLive(ball))
    {
      Keep(ball, point, Gap(PlaceOf(point), m_Balls[ball]));
    }
  }
  FindNeighbours(left);
  for (std::size_t vertex = 0; vertex < m_Standing.size(); ++vertex)
  {
    if (m_Standing[vertex].IsFree())
    {
      m_Turns.front().push_back(static_cast<ElementIndex>(vertex));
      ++m_Waiting;
    }
  }
}

void
LooseEnds::FindNeighbours(const LiveElements & left)
{
  const auto isLeft = [&](std::size_t edge) { return left.edges.empty() || left.edges[edge] != 0; };
  for (std::size_t edge = 0; edge < m_Cells.edges.size(); ++edge)
  {
    if (isLeft(edge))
    {
      m_Standing[m_Cells.edges[edge][0]].Add(static_cast<ElementIndex>(edge));
      m_Standing[m_Cells.edges[edge][1]].Add(static_cast<ElementIndex>(edge));
    }
  }
  // Filled from the ends of their places backwards, so that each vertex is left with where its own begin.
  m_FirstNeighbour.reserve(m_Cells.vertexCount + 1);
  std::uint32_t end = 0;
  for (std::size_t vertex = 0; vertex < m_Cells.vertexCount; ++vertex)
  {
    end += IsLive(static_cast<ElementIndex>(vertex)) ? m_Standing[vertex].Count() : 0;
    m_FirstNeighbour.push_back(end);
  }
  m_FirstNeighbour.push_back(end);
  m_Neighbours.resize(end);
  for (std::size_t edge = m_Cells.edges.size(); edge-- > 0;)
  {
    if (isLeft(edge))
    {
      const auto & [a, b] = m_Cells.edges[edge];
      m_Neighbours[--m_FirstNeighbour[a]] = b;
      m_Neighbours[--m_FirstNeighbour[b]] = a;
    }
  }
}

void
LooseEnds::Drop(ElementIndex edge)
{
  for (const ElementIndex vertex : m_Cells.edges[edge])
  {
    if (IsLive(vertex))
    {
      m_Standing[vertex].Remove(edge);
      // A vertex in one edge is in no face, as a face would need two edges there; so the edges at it suffice.
      if (m_Standing[vertex].IsFree())
      {
        m_Open.push_back(vertex);
      }
    }
  }
}

void
LooseEnds::TakeOpen()
{
  // What can go at this level goes at once, end by end, while it is at hand.
  while (!m_Open.empty())
  {
    const ElementIndex vertex = m_Open.back();
    m_Open.pop_back();
    if (!m_Standing[vertex].IsFree())
    {
      continue;
    }
    const double cost = CostOf(vertex);
    if (cost <= m_Height)
    {
      Remove(vertex);
    }
    else
    {
      m_Turns[m_Levels.LevelOf(cost)].push_back(vertex);
      ++m_Waiting;
    }
  }
}

void
LooseEnds::Remove(ElementIndex vertex)
{
  const ElementIndex edge = m_Standing[vertex].Coface();
  m_Standing[vertex].Go(m_Height);
  m_Gone.emplace_back(edge, vertex);
  if (m_ToHeir)
  {
    HandOver(vertex, m_Heir, m_HeirGap);
  }
  else
  {
    std::uint32_t point = m_NextKept[m_Balls[vertex].lastKept];
    for (const Home & home : m_NewHomes)
    {
      const std::uint32_t next = m_NextKept[point];
      Keep(home.vertex, point, home.gap);
      point = next;
    }
  }
  Drop(edge);
}

void
LooseEnds::FetchAhead(std::span<const ElementIndex> burnt, std::size_t at) const
{
  if (at + 32 < burnt.size())
  {
    FetchLine(&m_Cells.edges[burnt[at + 32]]);
  }
  if (at + 24 < burnt.size())
  {
    for (const ElementIndex vertex : m_Cells.edges[burnt[at + 24]])
    {
      FetchLine(&m_Standing[vertex]);
    }
  }
  // Of a vertex whose last edge but one this is, that last edge, and then what stands at its other end.
  const auto other = [&](std::size_t ahead, const auto & work) {
    if (at + ahead >= burnt.size())
    {
      return;
    }
    const ElementIndex edge = burnt[at + ahead];
    for (const ElementIndex vertex : m_Cells.edges[edge])
    {
      if (IsLive(vertex) && m_Standing[vertex].Count() == 2)
      {
        work(vertex, m_Standing[vertex].Coface() ^ edge);
      }
    }
  };
  other(16, [&](ElementIndex vertex, ElementIndex last) {
    FetchLine(&m_Balls[vertex]);
    FetchLine(&m_Cells.edges[last]);
  });
  other(8, [&](ElementIndex vertex, ElementIndex last) {
    const auto &       ends = m_Cells.edges[last];
    const ElementIndex heir = ends[0] == vertex ? ends[1] : ends[0];
    FetchLine(&m_Balls[heir]);
    FetchLine(&m_Standing[heir]);
    if (const std::uint32_t kept = m_Balls[vertex].lastKept; kept != kNobody)
    {
      FetchLine(&m_NextKept[kept]);
    }
  });
}

void
LooseEnds::Take(std::size_t level, std::span<const ElementIndex> burnt)
{
  m_Height = m_Levels.Height(level);
  std::vector<ElementIndex> turns;
  turns.swap(m_Turns[level]);
  m_Waiting -= turns.size();
  for (std::size_t i = 0; i < burnt.size(); ++i)
  {
    FetchAhead(burnt, i);
    Drop(burnt[i]);
    TakeOpen();
  }
  for (const ElementIndex vertex : turns)
  {
    m_Open.push_back(vertex);
    TakeOpen();
  }
}

std::vector<double>
LooseEnds::TakeVertexHeights()
{
  std::vector<double> heights = HeightsOf(m_Standing);
  std::vector<RemainingElements>().swap(m_Standing);
  return heights;
}

} // namespace voxelcore
