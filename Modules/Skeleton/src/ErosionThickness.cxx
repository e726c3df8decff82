#include "voxelcore/ErosionThickness.h"

#include "BurnNetwork.h"
#include "PointGeometry.h"
#include "TimeHeap.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace voxelcore
{

namespace
{

constexpr double        kNever = std::numeric_limits<double>::infinity();
constexpr std::uint32_t kNoSector = 0xFFFFFFFFU;
constexpr std::uint32_t kNoEntries = 0xFFFFFFFFU;

// In a face of so many points fire spreads over all of it faster than it finds out whether that is of use.
constexpr std::uint32_t kSmallFace = 16;

// The times of fire that comes straight and of fire that waited nowhere on the same way differ by rounding.
constexpr double kRounding = 1 + 1e-14;

/** Fire that has come to a point of a face and spread from there over all of it. Another point of the face that burns
 *  no earlier than straight fire from here is there has nothing to add: all it could reach, this has reached before. So
 *  most points need not spread, and a face costs the square of the points where fire enters it instead of all. They
 *  spread along their edges only: on one line the way in two parts is as long as that in one, and the times must not
 *  depend, by rounding, on which of them came to be remembered. The first few are, in a cache line. */
struct Entries
{
  static constexpr std::uint32_t most = 5;

  std::array<double, most>        times;
  std::array<std::uint32_t, most> points;
  std::uint32_t                   count = 0;
};

/** Dijkstra in which a point burns sector by sector (section 5.2 of the paper). */
class Fire
{
public:
  Fire(const MedialComplex & complex, double sampling)
    : m_Complex(complex)
    , m_Cells(complex.cells)
    , m_Network(complex, sampling)
    , m_Arrival(m_Network.SectorCount(), kNever)
    , m_FaceEntries(m_Cells.FaceCount(), kNoEntries)
    , m_Heap(FireBucket(complex.radius))
  {
    for (std::size_t face = 0; face < m_Cells.FaceCount(); ++face)
    {
      std::uint32_t points = 0;
      for (const ElementIndex edge : m_Cells.FaceEdges(face))
      {
        points += 1 + m_Network.SampleCount(edge);
      }
      if (points > kSmallFace)
      {
        m_FaceEntries[face] = static_cast<std::uint32_t>(m_Entries.size());
        m_Entries.emplace_back();
      }
    }
  }

  BurnTimes
  Run(const ProgressCallback & progress)
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

private:
  using SectorRange = BurnNetwork::SectorRange;

  bool
  IsBurned(std::uint32_t sector) const
  {
    return std::signbit(m_Arrival[sector]);
  }

  void
  Burn(std::uint32_t sector, double time)
  {
    m_Arrival[sector] = -time;
    m_Fresh.push_back(sector);
  }

  friend TimeHeap;

  /** When the next sector of a point burns; NaN when it waits for no fire. */
  double
  operator()(std::uint32_t point) const
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

  /** Points burn all over the surface in turn; what the next ones need is fetched from memory meanwhile, step by step:
   *  where a point is, where its edge's data are, these. */
  void
  Fetch(std::uint32_t point, int step) const
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
  FetchAhead() const
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
        const std::uint32_t face = m_Network.cornerFace[m_Network.edgeSides[side]];
        __builtin_prefetch(&m_FaceEntries[face]);
        __builtin_prefetch(&m_Cells.faceOffsets[face]);
      }
      __builtin_prefetch(&m_Complex.positions[m_Cells.edges[edge][0]]);
      __builtin_prefetch(&m_Complex.positions[m_Cells.edges[edge][1]]);
    }
  }

  void
  Ignite()
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
  BurnPoint(std::uint32_t point, double time)
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
    if (const double next = (*this)(point); left > 0 && !std::isnan(next))
    {
      m_Heap.PushAgain({ next, point });
    }
  }

  /** An unburned sector with an end on an edge where no other end is unburned. */
  std::uint32_t
  FindFreedSector(std::uint32_t point, const SectorRange & range)
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
    m_Ends.clear();
    for (std::uint32_t i = m_Network.vertexCornerOffsets[point]; i < m_Network.vertexCornerOffsets[point + 1]; ++i)
    {
      const std::uint32_t corner = m_Network.vertexCorners[i];
      const std::uint32_t sector = m_Network.cornerSector[corner];
      if (!IsBurned(sector))
      {
        for (const std::uint32_t side : { m_Network.SideBefore(corner), corner })
        {
          if (m_Network.EdgeFaceCount(m_Cells.faceEdges[side]) >= 3)
          {
            m_Ends.push_back({ m_Cells.faceEdges[side], sector });
          }
        }
      }
    }
    std::sort(m_Ends.begin(), m_Ends.end());
    for (std::size_t i = 0; i < m_Ends.size(); ++i)
    {
      const bool sameBefore = i > 0 && m_Ends[i - 1][0] == m_Ends[i][0];
      const bool sameAfter = i + 1 < m_Ends.size() && m_Ends[i + 1][0] == m_Ends[i][0];
      if (!sameBefore && !sameAfter)
      {
        return m_Ends[i][1];
      }
    }
    return kNoSector;
  }

  bool
  IsFresh(std::uint32_t sector) const
  {
    return std::find(m_Fresh.begin(), m_Fresh.end(), sector) != m_Fresh.end();
  }

  void
  Spread(std::uint32_t point, const SectorRange & range, double time)
  {
    const Flame flame{ point, m_Network.Position(point), time };
    if (point < m_Cells.vertexCount)
    {
      for (std::uint32_t i = m_Network.vertexCornerOffsets[point]; i < m_Network.vertexCornerOffsets[point + 1]; ++i)
      {
        const std::uint32_t corner = m_Network.vertexCorners[i];
        if (IsFresh(m_Network.cornerSector[corner]) && !SpreadInFace(flame, m_Network.cornerFace[corner]))
        {
          SpreadAlong(flame, m_Network.SideBefore(corner));
          SpreadAlong(flame, corner);
        }
      }
      return;
    }
    const ElementIndex  edge = m_Network.pointEdge[point - m_Cells.vertexCount];
    const std::uint32_t first = m_Network.edgeFirst[edge].side;
    bool                isDone = false; // along the edge, which two faces share
    for (std::uint32_t i = first; i < m_Network.edgeFirst[edge + 1].side; ++i)
    {
      const std::uint32_t side = m_Network.edgeSides[i];
      if (range.count == 1 || IsFresh(range.first + (i - first) * range.stride))
      {
        if (!SpreadInFace(flame, m_Network.cornerFace[side]) && (range.count > 1 || !isDone))
        {
          SpreadAlong(flame, side);
        }
        isDone = true;
      }
    }
  }

  /** A point that burns now. */
  struct Flame
  {
    std::uint32_t point;
    Point3        place;
    double        time;
  };

  /** Whether other fire in this face has reached before all that fire from here could. */
  bool
  IsOvertaken(const Flame & flame, const Entries & entries) const
  {
    for (std::uint32_t i = 0; i < entries.count; ++i)
    {
      if (entries.times[i] + Distance(m_Network.Position(entries.points[i]), flame.place) <= flame.time * kRounding)
      {
        return true;
      }
    }
    return false;
  }

  /** False when it is of no use but along the edges the point is on. */
  bool
  SpreadInFace(const Flame & flame, std::uint32_t face)
  {
    if (m_FaceEntries[face] != kNoEntries)
    {
      Entries & entries = m_Entries[m_FaceEntries[face]];
      if (IsOvertaken(flame, entries))
      {
        return false;
      }
      if (entries.count < Entries::most)
      {
        entries.times[entries.count] = flame.time;
        entries.points[entries.count++] = flame.point;
      }
    }
    const std::uint64_t end = m_Cells.faceOffsets[face + std::size_t{ 1 }];
    for (std::uint64_t at = m_Cells.faceOffsets[face]; at < end; ++at)
    {
      SpreadToCorner(flame, static_cast<std::uint32_t>(at));
      SpreadToSamples(flame, static_cast<std::uint32_t>(at));
    }
    return true;
  }

  /** Along the edge that begins in this corner of a face, both ends included. */
  void
  SpreadAlong(const Flame & flame, std::uint32_t corner)
  {
    SpreadToCorner(flame, corner);
    SpreadToSamples(flame, corner);
    SpreadToCorner(flame, m_Network.CornerAfter(corner));
  }

  void
  SpreadToCorner(const Flame & flame, std::uint32_t corner)
  {
    const ElementIndex vertex = m_Cells.faceVertices[corner];
    Reach(
      flame,
      m_Network.cornerSector[corner],
      [&] { return m_Complex.positions[vertex]; },
      [&] { return m_Complex.radius[vertex]; },
      vertex);
  }

  void
  SpreadToSamples(const Flame & flame, std::uint32_t corner)
  {
    const ElementIndex  edge = m_Cells.faceEdges[corner];
    const std::uint32_t count = m_Network.SampleCount(edge);
    const std::uint32_t sector = m_Network.FirstSideSector(corner);
    const Point3 &      a = m_Complex.positions[m_Cells.edges[edge][0]];
    const Point3 &      b = m_Complex.positions[m_Cells.edges[edge][1]];
    for (std::uint32_t i = 0; i < count; ++i)
    {
      Reach(
        flame,
        sector + i,
        [&] { return BurnNetwork::SamplePosition(a, b, i, count); },
        [&] { return m_Network.SampleRadius(edge, i); },
        m_Network.edgeFirst[edge].point + i);
    }
  }

  /** Notes when fire comes to a sector of a point, if that is earlier than any before. */
  template <typename Place, typename Radius>
  void
  Reach(const Flame & flame, std::uint32_t sector, const Place & place, const Radius & radius, std::uint32_t point)
  {
    const double left = m_Arrival[sector] - flame.time;
    if (left <= 0)
    {
      return; // burned, or as good as
    }
    const Point3 way = Minus(place(), flame.place);
    const double squared = Dot(way, way);
    if (squared >= left * left)
    {
      return;
    }
    const double arrival = std::max(flame.time + std::sqrt(squared), radius());
    if (arrival < m_Arrival[sector])
    {
      m_Heap.PushEarlier({ arrival, point }, std::exchange(m_Arrival[sector], arrival));
    }
  }

  /** When the last sector of a point burned. */
  double
  TimeOf(const SectorRange & range) const
  {
    double time = 0;
    for (std::uint32_t i = 0; i < range.count; ++i)
    {
      time = std::max(time, std::abs(m_Arrival[range.first + i * range.stride]));
    }
    return time;
  }

  /** One on no face is on the free boundary. */
  double
  TimeOfVertex(ElementIndex vertex) const
  {
    const SectorRange range = m_Network.Sectors(vertex);
    return range.count == 0 ? m_Complex.radius[vertex] : TimeOf(range);
  }

  BurnTimes
  Times() const
  {
    BurnTimes times;
    times.vertices.resize(m_Cells.vertexCount);
    for (std::uint32_t vertex = 0; vertex < m_Cells.vertexCount; ++vertex)
    {
      times.vertices[vertex] = TimeOfVertex(vertex);
    }
    times.edges.resize(m_Cells.edges.size());
    for (std::size_t edge = 0; edge < m_Cells.edges.size(); ++edge)
    {
      const std::uint32_t first = m_Network.edgeFirst[edge].point;
      const std::uint32_t end = m_Network.edgeFirst[edge + 1].point;
      double              sum = 0;
      for (std::uint32_t point = first; point < end; ++point)
      {
        sum += TimeOf(m_Network.Sectors(point));
      }
      const auto & ends = m_Cells.edges[edge];
      times.edges[edge] = first < end ? sum / (end - first) : 0.5 * (times.vertices[ends[0]] + times.vertices[ends[1]]);
    }
    times.faces.resize(m_Cells.FaceCount());
    for (std::size_t face = 0; face < m_Cells.FaceCount(); ++face)
    {
      const std::uint64_t first = m_Cells.faceOffsets[face];
      const std::uint64_t end = m_Cells.faceOffsets[face + 1];
      double              sum = 0;
      for (std::uint64_t corner = first; corner < end; ++corner)
      {
        sum += std::abs(m_Arrival[m_Network.cornerSector[corner]]);
      }
      times.faces[face] = sum / static_cast<double>(end - first);
    }
    return times;
  }

  const MedialComplex &                     m_Complex;
  const CellComplex &                       m_Cells;
  BurnNetwork                               m_Network;
  std::vector<double>                       m_Arrival;     ///< per sector; when it has burned, the negative of when
  std::vector<std::uint32_t>                m_FaceEntries; ///< per face
  std::vector<Entries>                      m_Entries;     ///< of faces that are not small
  TimeHeap                                  m_Heap;
  std::vector<std::uint32_t>                m_Fresh; ///< sectors of a point that burn now
  std::vector<std::array<std::uint32_t, 2>> m_Ends;  ///< (edge, sector) at a vertex
};

} // namespace

BurnTimes
ComputeBurnTimes(const MedialComplex & complex, double sampling, const ProgressCallback & progress)
{
  return Fire(complex, sampling).Run(progress);
}

} // namespace voxelcore
