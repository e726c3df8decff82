#include "voxelcore/ErosionThickness.h"

#include "BurnNetwork.h"
#include "TimeHeap.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace voxelcore
{

namespace
{

constexpr double kNever = std::numeric_limits<double>::infinity();

/** Dijkstra in which a point burns sector by sector (section 5.2 of the paper). */
class Fire
{
public:
  Fire(const MedialComplex & complex, double sampling)
    : m_Complex(complex)
    , m_Cells(complex.cells)
    , m_Network(complex, sampling)
    , m_Arrival(m_Network.openSector.size(), kNever)
    , m_Burned(m_Network.openSector.size(), 0)
    , m_Time(m_Network.radius.size(), kNever)
    , m_Heap(FireBucket(complex.radius))
  {}

  BurnTimes
  Run(const ProgressCallback & progress)
  {
    Ignite();
    std::size_t       pops = 0;
    const std::size_t points = m_Time.size();
    while (!m_Heap.IsEmpty())
    {
      const TimedElement next = m_Heap.Pop();
      if ((pops++ & 0xFFFFU) == 0)
      {
        ReportProgress(progress, "burning", std::min(1.0, static_cast<double>(pops) / static_cast<double>(points)));
      }
      BurnPoint(next.element, next.time);
    }
    return Times();
  }

private:
  void
  Ignite()
  {
    for (std::uint32_t point = 0; point < m_Time.size(); ++point)
    {
      const std::uint32_t first = m_Network.sectorOffsets[point];
      const std::uint32_t end = m_Network.sectorOffsets[point + std::size_t{ 1 }];
      bool                open = false;
      for (std::uint32_t sector = first; sector < end; ++sector)
      {
        if (m_Network.openSector[sector])
        {
          m_Arrival[sector] = m_Network.radius[point];
          open = true;
        }
      }
      if (open)
      {
        m_Heap.Push({ m_Network.radius[point], point });
      }
      if (first == end)
      {
        m_Time[point] = m_Network.radius[point]; // on no face: on the free boundary
      }
    }
  }

  const std::array<double, 3> &
  Position(std::uint32_t point) const
  {
    return point < m_Cells.vertexCount ? m_Complex.positions[point] : m_Network.positions[point - m_Cells.vertexCount];
  }

  void
  BurnPoint(std::uint32_t point, double time)
  {
    const std::uint32_t first = m_Network.sectorOffsets[point];
    const std::uint32_t end = m_Network.sectorOffsets[point + std::size_t{ 1 }];
    m_Fresh.clear();
    std::uint32_t left = 0;
    for (std::uint32_t sector = first; sector < end; ++sector)
    {
      if (!m_Burned[sector])
      {
        if (m_Arrival[sector] <= time)
        {
          m_Burned[sector] = 1;
          m_Fresh.push_back(sector);
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
    while (left > 0)
    {
      const std::uint32_t freed = FindFreedSector(point, first, end);
      if (freed == end)
      {
        break;
      }
      m_Burned[freed] = 1;
      m_Arrival[freed] = time;
      m_Fresh.push_back(freed);
      --left;
    }
    if (left == 0)
    {
      m_Time[point] = time;
    }
    Spread(point, time);
  }

  /** An unburned sector with an end on an edge where no other end is unburned; `end` when there is none. */
  std::uint32_t
  FindFreedSector(std::uint32_t point, std::uint32_t first, std::uint32_t end)
  {
    if (point >= m_Cells.vertexCount)
    {
      std::uint32_t found = end;
      for (std::uint32_t sector = first; sector < end; ++sector)
      {
        if (!m_Burned[sector])
        {
          if (found != end)
          {
            return end;
          }
          found = sector;
        }
      }
      return found;
    }
    m_Ends.clear();
    for (std::uint32_t i = m_Network.vertexCornerOffsets[point]; i < m_Network.vertexCornerOffsets[point + 1]; ++i)
    {
      const std::uint32_t corner = m_Network.vertexCorners[i];
      const std::uint32_t sector = m_Network.cornerSector[corner];
      if (!m_Burned[sector])
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
    return end;
  }

  bool
  IsFresh(std::uint32_t sector) const
  {
    return std::find(m_Fresh.begin(), m_Fresh.end(), sector) != m_Fresh.end();
  }

  void
  Spread(std::uint32_t point, double time)
  {
    if (point < m_Cells.vertexCount)
    {
      for (std::uint32_t i = m_Network.vertexCornerOffsets[point]; i < m_Network.vertexCornerOffsets[point + 1]; ++i)
      {
        const std::uint32_t corner = m_Network.vertexCorners[i];
        if (IsFresh(m_Network.cornerSector[corner]))
        {
          SpreadInFace(point, time, m_Network.cornerFace[corner]);
        }
      }
      return;
    }
    const ElementIndex edge = m_Network.pointEdge[point - m_Cells.vertexCount];
    for (std::uint32_t i = m_Network.edgeSideOffsets[edge]; i < m_Network.edgeSideOffsets[edge + 1]; ++i)
    {
      const std::uint32_t side = m_Network.edgeSides[i];
      if (IsFresh(m_Network.sectorOffsets[point] + m_Network.sideSector[side]))
      {
        SpreadInFace(point, time, m_Network.cornerFace[side]);
      }
    }
  }

  void
  SpreadInFace(std::uint32_t source, double time, std::uint32_t face)
  {
    const std::array<double, 3> from = Position(source);
    const auto                  reach = [&](std::uint32_t point, std::uint32_t sector) {
      const double left = m_Arrival[sector] - time;
      if (left <= 0 || m_Burned[sector])
      {
        return;
      }
      const auto & to = Position(point);
      const double dx = to[0] - from[0];
      const double dy = to[1] - from[1];
      const double dz = to[2] - from[2];
      const double squared = dx * dx + dy * dy + dz * dz;
      if (squared >= left * left)
      {
        return;
      }
      const double arrival = std::max(time + std::sqrt(squared), m_Network.radius[point]);
      if (arrival < m_Arrival[sector])
      {
        m_Arrival[sector] = arrival;
        m_Heap.Push({ arrival, point });
      }
    };
    for (std::uint64_t corner = m_Cells.faceOffsets[face]; corner < m_Cells.faceOffsets[face + std::size_t{ 1 }];
         ++corner)
    {
      reach(m_Cells.faceVertices[corner], m_Network.cornerSector[corner]);
      const ElementIndex edge = m_Cells.faceEdges[corner];
      for (std::uint32_t point = m_Network.edgePointOffsets[edge]; point < m_Network.edgePointOffsets[edge + 1];
           ++point)
      {
        reach(point, m_Network.sectorOffsets[point] + m_Network.sideSector[corner]);
      }
    }
  }

  BurnTimes
  Times() const
  {
    BurnTimes times;
    times.vertices.assign(m_Time.begin(), m_Time.begin() + static_cast<std::ptrdiff_t>(m_Cells.vertexCount));
    times.edges.resize(m_Cells.edges.size());
    for (std::size_t edge = 0; edge < m_Cells.edges.size(); ++edge)
    {
      const std::uint32_t first = m_Network.edgePointOffsets[edge];
      const std::uint32_t end = m_Network.edgePointOffsets[edge + 1];
      double              sum = 0;
      for (std::uint32_t point = first; point < end; ++point)
      {
        sum += m_Time[point];
      }
      const auto & ends = m_Cells.edges[edge];
      times.edges[edge] = first < end ? sum / (end - first) : 0.5 * (m_Time[ends[0]] + m_Time[ends[1]]);
    }
    times.faces.resize(m_Cells.FaceCount());
    for (std::size_t face = 0; face < m_Cells.FaceCount(); ++face)
    {
      const std::uint64_t first = m_Cells.faceOffsets[face];
      const std::uint64_t end = m_Cells.faceOffsets[face + 1];
      double              sum = 0;
      for (std::uint64_t corner = first; corner < end; ++corner)
      {
        sum += m_Arrival[m_Network.cornerSector[corner]];
      }
      times.faces[face] = sum / static_cast<double>(end - first);
    }
    return times;
  }

  const MedialComplex &                     m_Complex;
  const CellComplex &                       m_Cells;
  BurnNetwork                               m_Network;
  std::vector<double>                       m_Arrival; ///< per sector
  std::vector<std::uint8_t>                 m_Burned;  ///< per sector
  std::vector<double>                       m_Time;    ///< per point: when its last sector burned
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
