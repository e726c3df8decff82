#include "SurfaceFire.h"

#include <algorithm>
#include <bit>
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

void
SurfaceFire::SpreadAhead(const Flame & flame, FaceAhead & face, std::uint32_t place)
{
  face.ahead &= static_cast<std::uint16_t>(~(1U << place));
  const BurnNetwork::Side * sides = &m_Network.sides[face.first];
  // Whether fire comes earlier is hard to foretell: first of all, then what there is to do where it does.
  std::uint32_t                                reached = 0;
  std::array<double, 2 * FaceAhead::mostSides> squares;
  for (std::uint32_t left = face.ahead; left != 0; left &= left - 1)
  {
    const auto          at = static_cast<std::uint32_t>(std::countr_zero(left));
    const std::uint32_t i = at >> 1U;
    const std::uint32_t step = at & 1U;
    const double        most = m_Arrival[sides[i].sector[step]] - flame.time;
    const Vector3 &     a = m_Complex.positions[sides[i].point[0]];
    const Vector3 &     b = m_Complex.positions[sides[i + step == face.sides ? 0 : i + step].point[0]];
    // A corner is halfway between itself and itself.
    const Vector3 way =
      Minus(Vector3{ 0.5 * a[0] + 0.5 * b[0], 0.5 * a[1] + 0.5 * b[1], 0.5 * a[2] + 0.5 * b[2] }, flame.place);
    squares[at] = Dot(way, way);
    reached |= static_cast<std::uint32_t>((most > 0) & (squares[at] < most * most)) << at;
  }
  for (; reached != 0; reached &= reached - 1)
  {
    const auto                at = static_cast<std::uint32_t>(std::countr_zero(reached));
    const std::uint32_t       step = at & 1U;
    const BurnNetwork::Side & side = sides[at >> 1U];
    const std::uint32_t       a = side.point[0];
    double                    radius = m_Complex.radius[a];
    if (step == 1)
    {
      const std::uint32_t b = sides[(at >> 1U) + 1 == face.sides ? 0 : (at >> 1U) + 1].point[0];
      const Vector3       way = Minus(m_Complex.positions[b], m_Complex.positions[a]);
      radius = BurnNetwork::RadiusBetween(radius, m_Complex.radius[b], Dot(way, way), 0.5);
    }
    double &     before = m_Arrival[side.sector[step]];
    const double arrival = std::max(flame.time + std::sqrt(squares[at]), radius);
    if (arrival < before)
    {
      m_Heap.PushEarlier({ arrival, side.point[step] }, std::exchange(before, arrival));
    }
  }
}

bool
SurfaceFire::SpreadInFace(const Flame & flame, const BurnNetwork::FaceCorner & place, std::uint32_t step)
{
  const std::uint32_t face = place.face;
  if (FaceAhead & ahead = m_Faces[face]; ahead.sides > 0)
  {
    SpreadAhead(flame, ahead, 2 * (place.corner - ahead.first) + step);
    return true;
  }
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
SurfaceFire::SpreadAlong(const Flame & flame, const BurnNetwork::FaceCorner & at)
{
  SpreadToCorner(flame, at.corner);
  SpreadToSamples(flame, at.corner);
  SpreadToCorner(flame, m_Network.CornerAfter(at));
}

void
SurfaceFire::SpreadToCorner(const Flame & flame, std::uint32_t corner)
{
  const ElementIndex vertex = m_Cells.faceVertices[corner];
  Reach(
    flame,
    m_Network.sides[corner].sector[0],
    [&] { return m_Complex.positions[vertex]; },
    [&] { return m_Complex.radius[vertex]; },
    vertex);
}

void
SurfaceFire::SpreadToSamples(const Flame & flame, std::uint32_t corner)
{
  const ElementIndex  edge = m_Cells.faceEdges[corner];
  const std::uint32_t count = m_Network.SampleCount(edge);
  const std::uint32_t sector = m_Network.sides[corner].sector[1];
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
      const BurnNetwork::FaceCorner & at = m_Network.vertexCorners[i];
      if ((range.count == 1 || IsFresh(m_Network.sides[at.corner].sector[0])) && !SpreadInFace(flame, at, 0))
      {
        SpreadAlong(flame, { m_Network.SideBefore(at), at.face });
        SpreadAlong(flame, at);
      }
    }
    return;
  }
  const ElementIndex  edge = m_Network.pointEdge[point - m_Cells.vertexCount];
  const std::uint32_t first = m_Network.edgeFirst[edge].side;
  bool                isDone = false; // along the edge, which two faces share
  for (std::uint32_t i = first; i < m_Network.edgeFirst[edge + 1].side; ++i)
  {
    const BurnNetwork::FaceCorner & side = m_Network.edgeSides[i];
    if (range.count == 1 || IsFresh(range.first + (i - first) * range.stride))
    {
      if (!SpreadInFace(flame, side, 1) && (range.count > 1 || !isDone))
      {
        SpreadAlong(flame, side);
      }
      isDone = true;
    }
  }
}

} // namespace voxelcore
