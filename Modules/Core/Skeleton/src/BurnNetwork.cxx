#include "BurnNetwork.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Base/UnionFind.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <utility>

namespace voxelcore
{

namespace
{

// Along an edge whose radius grows so fast fire hardly needs longer than the radius says, from whichever point it
// comes. Most of the fringe that voxels make is like that.
constexpr double kSteep = 0.95;

constexpr std::size_t kFewVertices = 10000; // for one thread

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

/** Faces listed by the key each of their corners has: counting, then filling in order. */
void
Bucket(std::size_t                       keys,
       const CellComplex &               cells,
       const std::vector<ElementIndex> & keyOf,
       std::vector<std::uint32_t> &      offsets,
       std::vector<std::uint32_t> &      faces)
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
  faces.resize(keyOf.size());
  std::vector<std::uint32_t> next(offsets.begin(), offsets.end() - 1);
  for (std::uint32_t face = 0; face < cells.FaceCount(); ++face)
  {
    for (std::uint64_t i = cells.faceOffsets[face]; i < cells.faceOffsets[face + std::size_t{ 1 }]; ++i)
    {
      faces[next[keyOf[i]]++] = face;
    }
  }
}

} // namespace

/** Sectors around one vertex, kept between vertices to save allocations. */
struct BurnNetwork::Fan
{
  /** An edge of a corner. */
  struct Side
  {
    std::uint32_t edge;
    std::uint32_t faces;
  };

  struct Corner
  {
    std::array<Side, 2> sides; ///< before and after
    std::uint32_t       at;
    std::uint32_t       rank;
  };

  std::vector<Corner>                                 corners;   ///< by face
  UnionFind                                           sets{ 0 }; ///< of corners, by position in the list: sectors
  std::vector<std::pair<ElementIndex, std::uint32_t>> seamEnds;  ///< edges and sectors
};

BurnNetwork::BurnNetwork(const MedialComplex & complex, double sampling)
  : m_Complex(&complex)
  , m_Cells(&complex.cells)
{
  RequireIndexable(complex.cells.faceVertices.size(), "corners");
  BuildIncidence();
  PlaceSamples(sampling);
  BuildSectors();
  BuildSides();
}

void
BurnNetwork::BuildIncidence()
{
  std::vector<std::uint32_t> faceOffsets;
  RunBoth(
    m_Cells->vertexCount > kFewVertices,
    [&] { Bucket(m_Cells->vertexCount, *m_Cells, m_Cells->faceVertices, vertexFaceOffsets, vertexFaces); },
    [&] { Bucket(m_Cells->edges.size(), *m_Cells, m_Cells->faceEdges, faceOffsets, edgeFaces); });
  edgeFirst.resize(faceOffsets.size());
  for (std::size_t edge = 0; edge < faceOffsets.size(); ++edge)
  {
    edgeFirst[edge].face = faceOffsets[edge];
  }
}

void
BurnNetwork::PlaceSamples(double sampling)
{
  const std::size_t edgeCount = m_Cells->edges.size();
  const auto        samplesOf = [&](std::size_t edge) {
    if (EdgeFaceCount(static_cast<ElementIndex>(edge)) == 0)
    {
      return 0U; // fire does not run along curves
    }
    const auto   ends = m_Cells->edges[edge];
    const double length = Distance(m_Complex->positions[ends[0]], m_Complex->positions[ends[1]]);
    if (std::abs(m_Complex->radius[ends[0]] - m_Complex->radius[ends[1]]) > kSteep * length)
    {
      return 0U;
    }
    const double ideal = sampling > 0 ? std::min(std::max(length / sampling - 1, 1.0), 1000.0) : 1.0;
    // NOLINTNEXTLINE(bugprone-incorrect-roundings): 1 to 1000, halves upwards
    return static_cast<std::uint32_t>(ideal + 0.5);
  };
  RunInParts(m_Cells->vertexCount > kFewVertices, edgeCount, [&](std::size_t first, std::size_t last) {
    for (std::size_t edge = first; edge < last; ++edge)
    {
      edgeFirst[edge].point = samplesOf(edge);
    }
  });
  std::uint64_t points = m_Cells->vertexCount;
  for (std::size_t edge = 0; edge < edgeCount; ++edge)
  {
    points += std::exchange(edgeFirst[edge].point, static_cast<std::uint32_t>(points));
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
  return RadiusBetween(ra, rb, Dot(way, way), static_cast<double>(rank + 1) / (SampleCount(edge) + 1));
}

BurnNetwork::SectorPart
BurnNetwork::FindSectors(std::size_t firstVertex, std::size_t lastVertex)
{
  SectorPart part{ firstVertex, lastVertex, {}, {} };
  Fan        fan;
  for (std::size_t vertex = firstVertex; vertex < lastVertex; ++vertex)
  {
    const auto firstSector = static_cast<std::uint32_t>(part.open.size());
    const auto firstEnd = static_cast<std::uint32_t>(part.seamEnds.size());
    vertexSectorOffsets[vertex] = firstSector;
    seamEndOffsets[vertex] = firstEnd;
    const std::uint32_t first = vertexFaceOffsets[vertex];
    const std::uint32_t count = vertexFaceOffsets[vertex + 1] - first;
    fan.corners.resize(count);
    fan.sets.Reset(count);
    for (std::uint32_t i = 0; i < count; ++i)
    {
      const FaceCorner at = CornerAt(vertexFaces[first + i], static_cast<ElementIndex>(vertex));
      Fan::Corner &    corner = fan.corners[i];
      corner.at = at.corner;
      const ElementIndex before = m_Cells->faceEdges[SideBefore(at)];
      const ElementIndex after = m_Cells->faceEdges[at.corner];
      corner.sides = { Fan::Side{ before, EdgeFaceCount(before) }, Fan::Side{ after, EdgeFaceCount(after) } };
      // Join what was seen before across an edge with two faces.
      for (const Fan::Side & side : corner.sides)
      {
        if (side.faces == 2)
        {
          const std::uint32_t * both = edgeFaces.data() + edgeFirst[side.edge].face;
          const std::uint32_t   other = both[0] == at.face ? both[1] : both[0];
          const auto            faces = vertexFaces.begin() + first;
          if (other < at.face)
          {
            fan.sets.Unite(i, static_cast<std::size_t>(std::lower_bound(faces, faces + i, other) - faces));
          }
        }
      }
    }
    for (std::uint32_t i = 0; i < count; ++i)
    {
      Fan::Corner &       corner = fan.corners[i];
      const std::uint32_t smallest = fan.sets.Find(i);
      if (smallest == i)
      {
        corner.rank = static_cast<std::uint32_t>(part.open.size());
        part.open.push_back(0);
      }
      corner.rank = fan.corners[smallest].rank;
      sides[corner.at].sector[0] = corner.rank;
      if (corner.sides[0].faces == 1 || corner.sides[1].faces == 1)
      {
        part.open[corner.rank] = 1;
      }
    }
    if (part.open.size() > firstSector + std::size_t{ 1 })
    {
      FindSeamEnds(fan, firstSector, part.seamEnds);
    }
  }
  return part;
}

void
BurnNetwork::FindSeamEnds(Fan & fan, std::uint32_t firstSector, std::vector<SeamEnd> & seamEnds)
{
  fan.seamEnds.clear();
  for (const Fan::Corner & corner : fan.corners)
  {
    for (const Fan::Side & side : corner.sides)
    {
      if (side.faces >= 3)
      {
        fan.seamEnds.emplace_back(side.edge, corner.rank - firstSector);
      }
    }
  }
  std::sort(fan.seamEnds.begin(), fan.seamEnds.end());
  for (std::size_t i = 0; i < fan.seamEnds.size(); ++i)
  {
    const auto & [edge, sector] = fan.seamEnds[i];
    const bool isLast = i + 1 == fan.seamEnds.size() || fan.seamEnds[i + 1].first != edge;
    seamEnds.push_back(sector | (isLast ? kLastAtSeam : 0));
  }
}

void
BurnNetwork::BuildSectors()
{
  const std::size_t vertexCount = m_Cells->vertexCount;
  const bool        worthIt = vertexCount > kFewVertices;
  vertexSectorOffsets.resize(vertexCount + 1);
  seamEndOffsets.resize(vertexCount + 1);
  sides.resize(m_Cells->faceVertices.size());
  std::vector<SectorPart> parts;
  std::mutex              guard;
  RunInParts(worthIt, vertexCount, [&](std::size_t first, std::size_t last) {
    SectorPart             part = FindSectors(first, last);
    const std::scoped_lock lock(guard);
    parts.push_back(std::move(part));
  });
  std::sort(parts.begin(), parts.end(), [](const SectorPart & a, const SectorPart & b) {
    return a.firstVertex < b.firstVertex;
  });
  // Each part numbered its own from 0 on.
  for (SectorPart & part : parts)
  {
    const auto firstSector = static_cast<std::uint32_t>(openSector.size());
    const auto firstEnd = static_cast<std::uint32_t>(seamEnds.size());
    RequireIndexable(openSector.size() + part.open.size(), "sectors"); // of a vertex they are fewer than 2^31
    openSector.insert(openSector.end(), part.open.begin(), part.open.end());
    seamEnds.insert(seamEnds.end(), part.seamEnds.begin(), part.seamEnds.end());
    std::vector<SeamEnd>().swap(part.seamEnds);
    if (firstSector == 0)
    {
      continue; // so are its seam ends
    }
    RunInParts(worthIt, part.lastVertex - part.firstVertex, [&](std::size_t first, std::size_t last) {
      for (std::size_t vertex = part.firstVertex + first; vertex < part.firstVertex + last; ++vertex)
      {
        vertexSectorOffsets[vertex] += firstSector;
        seamEndOffsets[vertex] += firstEnd;
        for (std::uint32_t i = vertexFaceOffsets[vertex]; i < vertexFaceOffsets[vertex + 1]; ++i)
        {
          sides[CornerAt(vertexFaces[i], static_cast<ElementIndex>(vertex)).corner].sector[0] += firstSector;
        }
      }
    });
  }
  seamEndOffsets.back() = static_cast<std::uint32_t>(seamEnds.size());
  vertexSectorOffsets.back() = static_cast<std::uint32_t>(openSector.size());
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

void
BurnNetwork::BuildSides()
{
  const bool worthIt = m_Cells->vertexCount > kFewVertices;
  RunInParts(worthIt, m_Cells->edges.size(), [&](std::size_t firstEdge, std::size_t lastEdge) {
    for (std::size_t edge = firstEdge; edge < lastEdge; ++edge)
    {
      const EdgeFirst &   at = edgeFirst[edge];
      const auto          number = static_cast<ElementIndex>(edge);
      const std::uint32_t row = EdgeFaceCount(number) >= 3 ? SampleCount(number) : 0;
      std::uint32_t       sector = at.sector;
      for (std::uint32_t i = at.face; i < edgeFirst[edge + 1].face; ++i, sector += row)
      {
        sides[SideAt(edgeFaces[i], number).corner].sector[1] = sector;
      }
    }
  });
}

void
BurnNetwork::EndIgnition()
{
  std::vector<std::uint8_t>().swap(openSector);
}

void
BurnNetwork::EndFire()
{
  std::vector<std::uint32_t>().swap(vertexFaceOffsets);
  std::vector<std::uint32_t>().swap(vertexFaces);
  std::vector<std::uint32_t>().swap(seamEndOffsets);
  std::vector<SeamEnd>().swap(seamEnds);
}

} // namespace voxelcore
