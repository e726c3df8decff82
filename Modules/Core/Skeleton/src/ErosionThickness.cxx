#include "voxelcore/Skeleton/ErosionThickness.h"

#include "SurfaceFire.h"

#include "voxelcore/Base/ParallelTasks.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{

double
SurfaceFire::TimeOf(const SectorRange & range) const
{
  double time = 0;
  for (std::uint32_t i = 0; i < range.count; ++i)
  {
    time = std::max(time, std::abs(m_Times[range.first + i * range.stride]));
  }
  return time;
}

double
SurfaceFire::TimeOfVertex(ElementIndex vertex) const
{
  const SectorRange range = m_Network.Sectors(vertex);
  return range.count == 0 ? m_Complex.radius[vertex] : TimeOf(range);
}

double
SurfaceFire::TimeOfEdge(ElementIndex edge, const std::vector<double> & vertices) const
{
  const BurnNetwork::EdgeFirst & first = m_Network.edgeFirst[edge];
  const BurnNetwork::EdgeFirst & end = m_Network.edgeFirst[edge + std::size_t{ 1 }];
  double                         time = 0;
  if (first.point < end.point)
  {
    for (std::uint32_t point = first.point; point < end.point; ++point)
    {
      time += TimeOf(m_Network.Sectors(point));
    }
    return time / (end.point - first.point);
  }
  if (first.face == end.face)
  {
    const auto & ends = m_Cells.edges[edge];
    return 0.5 * (vertices[ends[0]] + vertices[ends[1]]);
  }
  for (std::uint32_t i = first.face; i < end.face; ++i)
  {
    const BurnNetwork::FaceCorner at = m_Network.SideAt(m_Network.edgeFaces[i], edge);
    const double                  begin = Time(m_Network.sides[at.corner].sector[0]);
    const double                  next = Time(m_Network.sides[m_Network.CornerAfter(at)].sector[0]);
    time = std::max(time, 0.5 * (std::abs(begin) + std::abs(next)));
  }
  return time;
}

BurnTimes
SurfaceFire::Times() const
{
  BurnTimes  times;
  const auto timeOfFace = [&](std::size_t face) {
    const std::uint64_t first = m_Cells.faceOffsets[face];
    const std::uint64_t end = m_Cells.faceOffsets[face + 1];
    double              sum = 0;
    for (std::uint64_t corner = first; corner < end; ++corner)
    {
      sum += std::abs(m_Times[m_Network.sides[corner].sector[0]]);
    }
    return sum / static_cast<double>(end - first);
  };
  const auto fill = [&](std::vector<double> & values, std::size_t count, const auto & timeOf) {
    values.resize(count);
    RunInParts(count > 10000, count, [&](std::size_t first, std::size_t last) {
      for (std::size_t element = first; element < last; ++element)
      {
        values[element] = timeOf(element);
      }
    });
  };
  const auto index = [](std::size_t element) { return static_cast<ElementIndex>(element); };
  fill(times.vertices, m_Cells.vertexCount, [&](std::size_t vertex) { return TimeOfVertex(index(vertex)); });
  fill(times.edges, m_Cells.edges.size(), [&](std::size_t edge) { return TimeOfEdge(index(edge), times.vertices); });
  fill(times.faces, m_Cells.FaceCount(), timeOfFace);
  return times;
}

BurnTimes
ComputeBurnTimes(const MedialComplex & complex, double sampling, const ProgressCallback & progress)
{
  const auto isLength = [](double value) { return value >= 0 && std::isfinite(value); };
  const auto isPlace = [](const Vector3 & place) { return std::isfinite(place[0] + place[1] + place[2]); };
  if (!std::all_of(complex.radius.begin(), complex.radius.end(), isLength) ||
      !std::all_of(complex.positions.begin(), complex.positions.end(), isPlace))
  {
    throw InputError(
      "a radius of the medial surface is below 0, or a radius or place is no finite number; make the surface again");
  }
  return SurfaceFire(complex, sampling).Run(progress);
}

} // namespace voxelcore
