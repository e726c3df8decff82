#include "SurfaceFire.h"

#include <algorithm>
#include <bit>

namespace voxelcore
{

namespace
{

// The times of fire that comes straight and of fire that waited nowhere on the same way differ by rounding.
constexpr double kRounding = 1 + 1e-14;

} // namespace

template <typename Place, typename Radius, typename Point>
void
SurfaceFire::Reach(Block &        block,
                   Queue &        queue,
                   const Flame &  flame,
                   std::uint32_t  sector,
                   const Place &  place,
                   const Radius & radius,
                   const Point &  pointOf)
{
  const double before = Time(sector);
  const double left = std::abs(before) - flame.time;
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
  const double time = std::max(flame.time + std::sqrt(squared), radius());
  if (time >= std::abs(before))
  {
    return;
  }
  const std::uint32_t point = pointOf();
  if (block.Has(point, m_Cells.vertexCount))
  {
    Arrive(block, queue, { time, sector, point }, before);
  }
  else
  {
    Send(block, queue, { time, sector, point });
  }
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
SurfaceFire::SpreadInSmallFace(Block & block, Queue & queue, const Flame & flame, std::uint32_t face)
{
  const std::uint64_t  first = m_Cells.faceOffsets[face];
  const auto           count = static_cast<std::uint32_t>(m_Cells.faceOffsets[face + std::size_t{ 1 }] - first);
  const auto *         sides = &m_Network.sides[first];
  const ElementIndex * vertices = &m_Cells.faceVertices[first];
  for (std::uint32_t left = m_Small[face]; left != 0; left &= left - 1)
  {
    const auto          at = static_cast<std::uint32_t>(std::countr_zero(left));
    const std::uint32_t i = at >> 1U;
    const std::uint32_t vertex = vertices[i];
    const Vector3 &     a = m_Complex.positions[vertex];
    if ((at & 1U) == 0)
    {
      Reach(
        block,
        queue,
        flame,
        sides[i].sector[0],
        [&]() -> const Vector3 & { return a; },
        [&] { return m_Complex.radius[vertex]; },
        [&] { return vertex; });
      continue;
    }
    const std::uint32_t next = vertices[i + 1 == count ? 0 : i + 1];
    const Vector3 &     b = m_Complex.positions[next];
    Reach(
      block,
      queue,
      flame,
      sides[i].sector[1],
      [&] {
        return Vector3{ 0.5 * a[0] + 0.5 * b[0], 0.5 * a[1] + 0.5 * b[1], 0.5 * a[2] + 0.5 * b[2] };
      },
      [&] {
        const Vector3 way = Minus(b, a);
        return BurnNetwork::RadiusBetween(m_Complex.radius[vertex], m_Complex.radius[next], Dot(way, way), 0.5);
      },
      [&] { return m_Network.edgeFirst[m_Cells.faceEdges[first + i]].point; });
  }
}

bool
SurfaceFire::SpreadInFace(Block & block, Queue & queue, const Flame & flame, const BurnNetwork::FaceCorner & at)
{
  const std::uint32_t face = at.face;
  if (m_Small[face] != 0)
  {
    SpreadInSmallFace(block, queue, flame, face);
    return true;
  }
  if (const std::uint32_t place = m_Entries.empty() ? EntryPlaces::none : m_EntryPlaces.Of(face);
      place != EntryPlaces::none)
  {
    Entries & entries = m_Entries[place];
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
  for (std::uint64_t corner = m_Cells.faceOffsets[face]; corner < end; ++corner)
  {
    SpreadToCorner(block, queue, flame, static_cast<std::uint32_t>(corner));
    SpreadToSamples(block, queue, flame, static_cast<std::uint32_t>(corner));
  }
  return true;
}

void
SurfaceFire::SpreadAlong(Block & block, Queue & queue, const Flame & flame, const BurnNetwork::FaceCorner & at)
{
  SpreadToCorner(block, queue, flame, at.corner);
  SpreadToSamples(block, queue, flame, at.corner);
  SpreadToCorner(block, queue, flame, m_Network.CornerAfter(at));
}

void
SurfaceFire::SpreadToCorner(Block & block, Queue & queue, const Flame & flame, std::uint32_t corner)
{
  const ElementIndex vertex = m_Cells.faceVertices[corner];
  Reach(
    block,
    queue,
    flame,
    m_Network.sides[corner].sector[0],
    [&] { return m_Complex.positions[vertex]; },
    [&] { return m_Complex.radius[vertex]; },
    [&] { return vertex; });
}

void
SurfaceFire::SpreadToSamples(Block & block, Queue & queue, const Flame & flame, std::uint32_t corner)
{
  const ElementIndex  edge = m_Cells.faceEdges[corner];
  const std::uint32_t count = m_Network.SampleCount(edge);
  const std::uint32_t sector = m_Network.sides[corner].sector[1];
  const Vector3 &     a = m_Complex.positions[m_Cells.edges[edge][0]];
  const Vector3 &     b = m_Complex.positions[m_Cells.edges[edge][1]];
  for (std::uint32_t i = 0; i < count; ++i)
  {
    Reach(
      block,
      queue,
      flame,
      sector + i,
      [&] { return BurnNetwork::SamplePosition(a, b, i, count); },
      [&] { return m_Network.SampleRadius(edge, i); },
      [&] { return m_Network.edgeFirst[edge].point + i; });
  }
}

void
SurfaceFire::Spread(Block & block, Queue & queue, std::uint32_t point, const SectorRange & range)
{
  Flame      flame{ point, m_Network.Position(point), 0 };
  const auto isFresh = [&](std::uint32_t sector) {
    return range.count == 1 || std::find(queue.fresh.begin(), queue.fresh.end(), sector) != queue.fresh.end();
  };
  if (point < m_Cells.vertexCount)
  {
    for (std::uint32_t i = m_Network.vertexFaceOffsets[point]; i < m_Network.vertexFaceOffsets[point + 1]; ++i)
    {
      const BurnNetwork::FaceCorner at = m_Network.CornerAt(m_Network.vertexFaces[i], point);
      const std::uint32_t           sector = m_Network.sides[at.corner].sector[0];
      if (isFresh(sector))
      {
        flame.time = std::abs(Time(sector));
        if (!SpreadInFace(block, queue, flame, at))
        {
          SpreadAlong(block, queue, flame, { m_Network.SideBefore(at), at.face });
          SpreadAlong(block, queue, flame, at);
        }
      }
    }
    return;
  }
  const ElementIndex  edge = m_Network.pointEdge[point - m_Cells.vertexCount];
  const std::uint32_t first = m_Network.edgeFirst[edge].face;
  bool                isDone = false; // along the edge, which two faces share
  for (std::uint32_t i = first; i < m_Network.edgeFirst[edge + 1].face; ++i)
  {
    const BurnNetwork::FaceCorner side = m_Network.SideAt(m_Network.edgeFaces[i], edge);
    const std::uint32_t           sector = range.first + (range.count > 1 ? (i - first) * range.stride : 0);
    if (isFresh(sector))
    {
      flame.time = std::abs(Time(sector));
      if (!SpreadInFace(block, queue, flame, side) && (range.count > 1 || !isDone))
      {
        SpreadAlong(block, queue, flame, side);
      }
      isDone = true;
    }
  }
}

} // namespace voxelcore
