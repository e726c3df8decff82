#include "BurnNetwork.h"

#include "voxelcore/Error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace voxelcore
{

namespace
{

constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max() - 1;

void
RequireIndexable(std::uint64_t count, const char * what)
{
  if (count > kMost)
  {
    throw InputError(std::string("the medial surface has too many ") + what +
                     " for a skeleton (2^32 - 2); prune it further with a greater lambda");
  }
}

/** Lists by key from (key, value) pairs: counting, then filling in order. */
void
Bucket(std::size_t                       keys,
       const std::vector<ElementIndex> & keyOf,
       std::vector<std::uint32_t> &      offsets,
       std::vector<std::uint32_t> &      values)
{
  offsets.assign(keys + 1, 0);
  for (const ElementIndex key : keyOf)
  {
    ++offsets[key + std::size_t{ 1 }];
  }
  for (std::size_t key = 0; key < keys; ++key)
  {
    offsets[key + 1] += offsets[key];
  }
  values.resize(keyOf.size());
  std::vector<std::uint32_t> next(offsets.begin(), offsets.end() - 1);
  for (std::size_t i = 0; i < keyOf.size(); ++i)
  {
    values[next[keyOf[i]]++] = static_cast<std::uint32_t>(i);
  }
}

/** Sectors around one vertex, kept between vertices to save allocations. */
struct Fan
{
  std::vector<std::uint32_t> before; ///< edge before each corner
  std::vector<std::uint32_t> after;  ///< edge after each corner
  std::vector<std::uint32_t> label;  ///< smallest corner (position in the list) of its sector
  std::vector<std::uint32_t> rank;
};

} // namespace

BurnNetwork::BurnNetwork(const MedialComplex & complex, double sampling)
  : m_Complex(&complex)
  , m_Cells(&complex.cells)
{
  RequireIndexable(complex.cells.faceVertices.size(), "corners");
  BuildIncidence();
  PlaceSamples(sampling);
  BuildSectors();
}

void
BurnNetwork::BuildIncidence()
{
  cornerFace.resize(m_Cells->faceVertices.size());
  for (std::size_t face = 0; face < m_Cells->FaceCount(); ++face)
  {
    std::fill(cornerFace.begin() + static_cast<std::ptrdiff_t>(m_Cells->faceOffsets[face]),
              cornerFace.begin() + static_cast<std::ptrdiff_t>(m_Cells->faceOffsets[face + 1]),
              static_cast<std::uint32_t>(face));
  }
  Bucket(m_Cells->vertexCount, m_Cells->faceVertices, vertexCornerOffsets, vertexCorners);
  std::vector<std::uint32_t> sideOffsets;
  Bucket(m_Cells->edges.size(), m_Cells->faceEdges, sideOffsets, edgeSides);
  edgeFirst.resize(sideOffsets.size());
  for (std::size_t edge = 0; edge < sideOffsets.size(); ++edge)
  {
    edgeFirst[edge].side = sideOffsets[edge];
  }
}

void
BurnNetwork::PlaceSamples(double sampling)
{
  const std::size_t edgeCount = m_Cells->edges.size();
  std::uint64_t     points = m_Cells->vertexCount;
  for (std::size_t edge = 0; edge < edgeCount; ++edge)
  {
    edgeFirst[edge].point = static_cast<std::uint32_t>(points);
    if (EdgeFaceCount(static_cast<ElementIndex>(edge)) == 0)
    {
      continue; // fire does not run along curves
    }
    const auto   ends = m_Cells->edges[edge];
    const double length = Distance(m_Complex->positions[ends[0]], m_Complex->positions[ends[1]]);
    const double ideal = sampling > 0 ? std::min(std::max(length / sampling - 1, 1.0), 1000.0) : 1.0;
    points += static_cast<std::uint32_t>(ideal + 0.5);
    RequireIndexable(points, "sample points");
  }
  edgeFirst[edgeCount].point = static_cast<std::uint32_t>(points);
  pointEdge.resize(points - m_Cells->vertexCount);
  for (std::size_t edge = 0; edge < edgeCount; ++edge)
  {
    for (std::uint32_t point = edgeFirst[edge].point; point < edgeFirst[edge + 1].point; ++point)
    {
      pointEdge[point - m_Cells->vertexCount] = static_cast<std::uint32_t>(edge);
    }
  }
}

double
BurnNetwork::SampleRadius(ElementIndex edge, std::uint32_t rank) const
{
  const auto &  ends = m_Cells->edges[edge];
  const Vector3 way = Minus(m_Complex->positions[ends[1]], m_Complex->positions[ends[0]]);
  const double  ra = m_Complex->radius[ends[0]];
  const double  rb = m_Complex->radius[ends[1]];
  const double  t = static_cast<double>(rank + 1) / (SampleCount(edge) + 1);
  const double  s = 1 - t;
  return std::sqrt(std::max(0.0, s * (ra * ra) + t * (rb * rb) - s * t * Dot(way, way)));
}

void
BurnNetwork::BuildSectors()
{
  vertexSectorOffsets.reserve(m_Cells->vertexCount + 1);
  cornerSector.assign(m_Cells->faceVertices.size(), 0);
  Fan fan;
  for (std::size_t vertex = 0; vertex < m_Cells->vertexCount; ++vertex)
  {
    vertexSectorOffsets.push_back(static_cast<std::uint32_t>(openSector.size()));
    const std::uint32_t first = vertexCornerOffsets[vertex];
    const std::uint32_t count = vertexCornerOffsets[vertex + 1] - first;
    fan.before.resize(count);
    fan.after.resize(count);
    fan.label.resize(count);
    fan.rank.resize(count);
    for (std::uint32_t i = 0; i < count; ++i)
    {
      const std::uint32_t corner = vertexCorners[first + i];
      fan.before[i] = m_Cells->faceEdges[SideBefore(corner)];
      fan.after[i] = m_Cells->faceEdges[corner];
      fan.label[i] = i;
      // Join the corners seen before that lie across an edge with two faces.
      for (std::uint32_t j = 0; j < i; ++j)
      {
        const auto shares = [&](std::uint32_t edge) {
          return (fan.before[j] == edge || fan.after[j] == edge) && EdgeFaceCount(edge) == 2;
        };
        if (fan.label[j] != fan.label[i] && (shares(fan.before[i]) || shares(fan.after[i])))
        {
          const std::uint32_t low = std::min(fan.label[i], fan.label[j]);
          const std::uint32_t high = std::max(fan.label[i], fan.label[j]);
          std::replace(fan.label.begin(), fan.label.begin() + i + 1, high, low);
        }
      }
    }
    for (std::uint32_t i = 0; i < count; ++i)
    {
      if (fan.label[i] == i)
      {
        fan.rank[i] = static_cast<std::uint32_t>(openSector.size());
        openSector.push_back(0);
      }
      const std::uint32_t sector = fan.rank[fan.label[i]];
      cornerSector[vertexCorners[first + i]] = sector;
      if (EdgeFaceCount(fan.before[i]) == 1 || EdgeFaceCount(fan.after[i]) == 1)
      {
        openSector[sector] = 1;
      }
    }
  }
  vertexSectorOffsets.push_back(static_cast<std::uint32_t>(openSector.size()));
  std::uint64_t sectors = openSector.size();
  for (ElementIndex edge = 0; edge < m_Cells->edges.size(); ++edge)
  {
    edgeFirst[edge].sector = static_cast<std::uint32_t>(sectors);
    const std::uint32_t faces = EdgeFaceCount(edge);
    sectors += std::uint64_t{ SampleCount(edge) } * (faces >= 3 ? faces : 1);
    RequireIndexable(sectors, "sectors");
  }
  edgeFirst.back().sector = static_cast<std::uint32_t>(sectors);
}

} // namespace voxelcore
