#include "voxelcore/ErosionThickness.h"

#include "SurfaceFire.h"

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
    time = std::max(time, std::abs(m_Arrival[range.first + i * range.stride]));
  }
  return time;
}

double
SurfaceFire::TimeOfVertex(ElementIndex vertex) const
{
  const SectorRange range = m_Network.Sectors(vertex);
  return range.count == 0 ? m_Complex.radius[vertex] : TimeOf(range);
}

BurnTimes
SurfaceFire::Times() const
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
      sum += std::abs(m_Arrival[m_Network.sides[corner].sector[0]]);
    }
    times.faces[face] = sum / static_cast<double>(end - first);
  }
  return times;
}

BurnTimes
ComputeBurnTimes(const MedialComplex & complex, double sampling, const ProgressCallback & progress)
{
  return SurfaceFire(complex, sampling).Run(progress);
}

} // namespace voxelcore
