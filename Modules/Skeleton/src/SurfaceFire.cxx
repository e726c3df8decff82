#include "SurfaceFire.h"

#include <algorithm>

namespace voxelcore
{

namespace
{

constexpr std::uint32_t kNoSector = 0xFFFFFFFFU;

// In a face of so many points fire spreads over all of it faster than it finds out whether that is of use.
constexpr std::uint32_t kSmallFace = 16;

} // namespace

SurfaceFire::SurfaceFire(const MedialComplex & complex, double sampling)
  : m_Complex(complex)
  , m_Cells(complex.cells)
  , m_Network(complex, sampling)
  , m_Arrival(m_Network.SectorCount(), kNever)
  , m_Faces(m_Cells.FaceCount() + 1)
  , m_FaceEntries(m_Cells.FaceCount(), Entries::none)
  , m_Heap(FireBucket(complex.radius))
{
  for (std::size_t face = 0; face < m_Cells.FaceCount(); ++face)
  {
    const auto    edges = m_Cells.FaceEdges(face);
    std::uint32_t points = 0;
    for (const ElementIndex edge : edges)
    {
      points += 1 + m_Network.SampleCount(edge);
    }
    m_Faces[face].first = static_cast<std::uint32_t>(m_Cells.faceOffsets[face]);
    if (edges.size() <= FaceAhead::mostSides && points == 2 * edges.size())
    {
      m_Faces[face].sides = static_cast<std::uint8_t>(edges.size());
      m_Faces[face].ahead = static_cast<std::uint16_t>((1U << points) - 1);
    }
    if (points > kSmallFace)
    {
      m_FaceEntries[face] = static_cast<std::uint32_t>(m_Entries.size());
      m_Entries.emplace_back();
    }
  }
}

BurnTimes
SurfaceFire::Run(const ProgressCallback & progress)
{
  Ignite();
  std::size_t       pops = 0;
  const std::size_t points = m_Network.PointCount();
  TimedElement      next;
  while (m_Heap.Pop(*this, next))
  {
    if ((pops++ & 0xFFFFU) == 0)
    {
      ReportProgress(progress, "burning", std::min(1.0, static_cast<double>(pops) / static_cast<double>(points)));
    }
    FetchAhead();
    BurnPoint(next.element, next.time);
  }
  return Times();
}

double
SurfaceFire::operator()(std::uint32_t point) const
{
  const SectorRange range = m_Network.Sectors(point);
  double            next = kNever;
  for (std::uint32_t i = 0; i < range.count; ++i)
  {
    const double arrival = m_Arrival[range.first + i * range.stride];
    next = !std::signbit(arrival) && arrival < next ? arrival : next;
  }
  return next < kNever ? next : std::numeric_limits<double>::quiet_NaN();
}

void
SurfaceFire::Fetch(std::uint32_t point, int step) const
{
  const bool   isSample = point >= m_Cells.vertexCount;
  const auto   sample = point - static_cast<std::uint32_t>(m_Cells.vertexCount);
  const void * what = nullptr;
  switch (step)
  {
    case 0:
      what = isSample ? &m_Network.pointEdge[sample] : &m_Network.vertexSectorOffsets[point];
      break;
    case 1:
      what = isSample ? static_cast<const void *>(&m_Network.edgeFirst[m_Network.pointEdge[sample]])
                      : &m_Network.vertexCornerOffsets[point];
      break;
    default:
    {
      const SectorRange range = m_Network.Sectors(point);
      for (std::uint32_t i = 1; i < range.count; ++i)
      {
        __builtin_prefetch(&m_Arrival[range.first + i * range.stride], 1);
      }
      what = range.count > 0 ? &m_Arrival[range.first] : nullptr;
      break;
    }
  }
  __builtin_prefetch(what, 1);
}

void
SurfaceFire::FetchAhead() const
{
  for (int step = 0; step < 3; ++step)
  {
    if (const TimedElement * item = m_Heap.Ahead(static_cast<std::size_t>(24 - 8 * step)))
    {
      Fetch(item->element, step);
    }
  }
  if (const TimedElement * item = m_Heap.Ahead(4); item != nullptr && item->element >= m_Cells.vertexCount)
  {
    const ElementIndex edge = m_Network.pointEdge[item->element - m_Cells.vertexCount];
    __builtin_prefetch(&m_Network.edgeSides[m_Network.edgeFirst[edge].side]);
    __builtin_prefetch(&m_Cells.edges[edge]);
  }
  if (const TimedElement * item = m_Heap.Ahead(2); item != nullptr && item->element >= m_Cells.vertexCount)
  {
    const ElementIndex edge = m_Network.pointEdge[item->element - m_Cells.vertexCount];
    for (std::uint32_t side = m_Network.edgeFirst[edge].side; side < m_Network.edgeFirst[edge + 1].side; ++side)
    {
      const BurnNetwork::FaceCorner & at = m_Network.edgeSides[side];
      __builtin_prefetch(&m_Faces[at.face], 1);
      __builtin_prefetch(&m_Network.sides[at.corner]);
    }
    __builtin_prefetch(&m_Complex.positions[m_Cells.edges[edge][0]]);
    __builtin_prefetch(&m_Complex.positions[m_Cells.edges[edge][1]]);
  }
}

void
SurfaceFire::Ignite()
{
  for (std::uint32_t vertex = 0; vertex < m_Cells.vertexCount; ++vertex)
  {
    const SectorRange range = m_Network.Sectors(vertex);
    bool              open = false;
    for (std::uint32_t sector = range.first; sector < range.first + range.count; ++sector)
    {
      if (m_Network.openSector[sector])
      {
        m_Arrival[sector] = m_Complex.radius[vertex];
        open = true;
      }
    }
    if (open)
    {
      m_Heap.Push({ m_Complex.radius[vertex], vertex });
    }
  }
  for (ElementIndex edge = 0; edge < m_Cells.edges.size(); ++edge)
  {
    if (m_Network.EdgeFaceCount(edge) == 1)
    {
      for (std::uint32_t i = 0; i < m_Network.SampleCount(edge); ++i)
      {
        const double radius = m_Network.SampleRadius(edge, i);
        m_Arrival[m_Network.edgeFirst[edge].sector + i] = radius;
        m_Heap.Push({ radius, m_Network.edgeFirst[edge].point + i });
      }
    }
  }
}

void
SurfaceFire::BurnPoint(std::uint32_t point, double time)
{
  const SectorRange range = m_Network.Sectors(point);
  m_Fresh.clear();
  std::uint32_t left = 0;
  for (std::uint32_t i = 0; i < range.count; ++i)
  {
    const std::uint32_t sector = range.first + i * range.stride;
    if (!IsBurned(sector))
    {
      if (m_Arrival[sector] <= time)
      {
        Burn(sector, time);
      }
      else
      {
        ++left;
      }
    }
  }
  if (m_Fresh.empty())
  {
    return; // an entry that an earlier arrival has overtaken
  }
  // A seam with one sheet left is a free edge: what is left there burns now too.
  for (; left > 0; --left)
  {
    const std::uint32_t freed = FindFreedSector(point, range);
    if (freed == kNoSector)
    {
      break;
    }
    Burn(freed, time);
  }
  Spread(point, range, time);
  if (left > 0)
  {
    if (const double next = (*this)(point); !std::isnan(next))
    {
      m_Heap.PushAgain({ next, point });
    }
  }
}

std::uint32_t
SurfaceFire::FindFreedSector(std::uint32_t point, const SectorRange & range)
{
  if (point >= m_Cells.vertexCount)
  {
    std::uint32_t found = kNoSector;
    for (std::uint32_t i = 0; i < range.count; ++i)
    {
      if (!IsBurned(range.first + i * range.stride))
      {
        if (found != kNoSector)
        {
          return kNoSector;
        }
        found = range.first + i * range.stride;
      }
    }
    return found;
  }
  std::uint32_t ends = 0; // in the same seam, of sectors that have not burned
  std::uint32_t last = kNoSector;
  ElementIndex  seam = 0;
  for (std::uint32_t i = m_Network.seamEndOffsets[point]; i < m_Network.seamEndOffsets[point + 1]; ++i)
  {
    const BurnNetwork::SeamEnd & end = m_Network.seamEnds[i];
    if (!IsBurned(end.sector))
    {
      if (end.edge != seam && ends == 1)
      {
        return last;
      }
      ends = end.edge == seam ? ends + 1 : 1;
      seam = end.edge;
      last = end.sector;
    }
  }
  return ends == 1 ? last : kNoSector;
}

} // namespace voxelcore
