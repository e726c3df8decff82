// The blocks in which a surface burns, and the faces that fire is spared.

#include "SurfaceFire.h"

#include "voxelcore/Base/ParallelTasks.h"

#include <algorithm>
#include <mutex>

namespace voxelcore
{

namespace
{

// Vertices whose data, with their share of edges and faces, are a megabyte.
constexpr std::size_t kBlock = 4096;

// Corners and samples that fit the bits of SurfaceFire::m_Small.
constexpr std::size_t kMostSides = 8;

// In a face of so many points fire spreads over all of it faster than it finds out whether that is of use.
constexpr std::uint32_t kSmallFace = 16;

} // namespace

void
SurfaceFire::CutBlocks()
{
  const std::size_t count = std::max<std::size_t>(1, m_Cells.vertexCount / kBlock);
  std::size_t       firstEdge = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    Block block;
    block.firstVertex = static_cast<std::uint32_t>(m_Cells.vertexCount * i / count);
    block.lastVertex = static_cast<std::uint32_t>(m_Cells.vertexCount * (i + 1) / count);
    // Edges go with their first end, where they are in order; any other cut is as right.
    const auto last = std::partition_point(m_Cells.edges.begin() + static_cast<std::ptrdiff_t>(firstEdge),
                                           m_Cells.edges.end(),
                                           [&](const auto & ends) { return ends[0] < block.lastVertex; });
    const auto lastEdge =
      i + 1 == count ? m_Cells.edges.size() : static_cast<std::size_t>(last - m_Cells.edges.begin());
    block.firstSample = m_Network.edgeFirst[firstEdge].point;
    block.lastSample = m_Network.edgeFirst[lastEdge].point;
    block.firstEdge = static_cast<ElementIndex>(firstEdge);
    block.lastEdge = static_cast<ElementIndex>(lastEdge);
    firstEdge = lastEdge;
    m_Blocks.push_back(std::move(block));
  }
}

std::size_t
SurfaceFire::OwnerOf(std::uint32_t point) const
{
  const bool isVertex = point < m_Cells.vertexCount;
  const auto after = std::partition_point(m_Blocks.begin(), m_Blocks.end(), [&](const Block & block) {
    return (isVertex ? block.lastVertex : block.lastSample) <= point;
  });
  return static_cast<std::size_t>(after - m_Blocks.begin());
}

void
SurfaceFire::FindFaces()
{
  m_Small.assign(m_Cells.FaceCount(), 0);
  std::vector<std::size_t> large;
  std::mutex               guard;
  RunInParts(m_Cells.FaceCount() > 10000, m_Cells.FaceCount(), [&](std::size_t first, std::size_t last) {
    std::vector<std::size_t> own;
    for (std::size_t face = first; face < last; ++face)
    {
      const auto    edges = m_Cells.FaceEdges(face);
      std::uint32_t points = 0;
      std::uint32_t mostSamples = 0;
      std::uint32_t bits = 0;
      for (std::size_t i = 0; i < edges.size(); ++i)
      {
        const std::uint32_t samples = m_Network.SampleCount(edges[i]);
        points += 1 + samples;
        mostSamples = std::max(mostSamples, samples);
        bits |= i < kMostSides ? (samples > 0 ? 3U : 1U) << (2 * i) : 0;
      }
      if (edges.size() <= kMostSides && mostSamples <= 1)
      {
        m_Small[face] = static_cast<std::uint16_t>(bits);
      }
      else if (points > kSmallFace && IsOfOneBlock(face))
      {
        own.push_back(face);
      }
    }
    const std::scoped_lock lock(guard);
    large.insert(large.end(), own.begin(), own.end());
  });
  if (!large.empty())
  {
    std::sort(large.begin(), large.end());
    m_EntryPlaces = EntryPlaces(large, m_Cells.FaceCount());
    m_Entries.resize(large.size());
  }
}

EntryPlaces::EntryPlaces(const std::vector<std::size_t> & faces, std::size_t faceCount)
  : m_Groups(faceCount / kGroup + 1)
{
  for (const std::size_t face : faces)
  {
    m_Groups[face / kGroup].faces |= std::uint64_t{ 1 } << face % kGroup;
  }
  std::uint32_t before = 0;
  for (Group & group : m_Groups)
  {
    group.before = before;
    before += CountBits(group.faces);
  }
}

bool
SurfaceFire::IsOfOneBlock(std::size_t face) const
{
  const Block & block = m_Blocks[OwnerOf(m_Cells.FaceVertices(face).front())];
  const auto    edges = m_Cells.FaceEdges(face);
  return std::all_of(edges.begin(), edges.end(), [&](ElementIndex edge) {
    const std::uint32_t first = m_Network.edgeFirst[edge].point;
    return block.Has(m_Cells.edges[edge][0], m_Cells.vertexCount) &&
           block.Has(m_Cells.edges[edge][1], m_Cells.vertexCount) &&
           (m_Network.SampleCount(edge) == 0 || block.Has(first, m_Cells.vertexCount));
  });
}

} // namespace voxelcore
