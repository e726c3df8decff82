#include "SurfaceFire.h"

#include <algorithm>
#include <utility>

namespace voxelcore
{

namespace
{

// The times of fire that comes straight and of fire that waited nowhere on the same way differ by rounding.
constexpr double kRounding = 1 + 1e-14;

} // namespace

template <typename Place, typename Radius>
void
SurfaceFire::Reach(const Flame &  flame,
                   std::uint32_t  sector,
                   const Place &  place,
                   const Radius & radius,
                   std::uint32_t  point)
{
  const double left = m_Arrival[sector] - flame.time;
  if (left <= 0)
  {
    return; // burned, or as good as
  }
  const Vector3 way = Minus(place(), flame.place);
  const double  squared = Dot(way, way);
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

bool
SurfaceFire::IsFresh(std::uint32_t sector) const
{
  return std::find(m_Fresh.begin(), m_Fresh.end(), sector) != m_Fresh.end();
}

bool
SurfaceFire::IsOvertaken(const Flame & flame, const Entries & entries) const
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

bool
SurfaceFire::SpreadInFace(const Flame & flame, std::uint32_t face)
{
  if (m_FaceEntries[face] != Entries::none)
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

void
SurfaceFire::SpreadAlong(const Flame & flame, std::uint32_t corner)
{
  SpreadToCorner(flame, corner);
  SpreadToSamples(flame, corner);
  SpreadToCorner(flame, m_Network.CornerAfter(corner));
}

void
SurfaceFire::SpreadToCorner(const Flame & flame, std::uint32_t corner)
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
SurfaceFire::SpreadToSamples(const Flame & flame, std::uint32_t corner)
{
  const ElementIndex  edge = m_Cells.faceEdges[corner];
  const std::uint32_t count = m_Network.SampleCount(edge);
  const std::uint32_t sector = m_Network.FirstSideSector(corner);
  const Vector3 &     a = m_Complex.positions[m_Cells.edges[edge][0]];
  const Vector3 &     b = m_Complex.positions[m_Cells.edges[edge][1]];
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

void
SurfaceFire::Spread(std::uint32_t point, const SectorRange & range, double time)
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

} // namespace voxelcore
