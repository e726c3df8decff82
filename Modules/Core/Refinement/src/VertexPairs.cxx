#include "VertexPairs.h"

#include "voxelcore/Base/Error.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace voxelcore
{

namespace
{

// The two boundary vertices that two sides of a face share: facets of a convex cell meet in an edge. Twice the same
// where there are no two.
PointPair
PairBetween(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b)
{
  PointPair   pair{};
  std::size_t found = 0;
  for (const std::uint32_t point : a)
  {
    if (found < 2 && std::find(b.begin(), b.end(), point) != b.end())
    {
      pair[found++] = point;
    }
  }
  if (found < 2)
  {
    return {};
  }
  return { std::min(pair[0], pair[1]), std::max(pair[0], pair[1]) };
}

} // namespace

std::vector<PointPair>
PairsOfFaces(const EdgePoints & edgePoints, const CellComplex & cells, std::span<const ElementIndex> edgeIds)
{
  std::vector<PointPair> pairs(cells.FaceCount());
  const auto             faces = static_cast<std::ptrdiff_t>(pairs.size());
#pragma omp parallel for schedule(static) if (faces > 4096)
  for (std::ptrdiff_t face = 0; face < faces; ++face)
  {
    const auto edges = cells.FaceEdges(static_cast<std::size_t>(face));
    pairs[static_cast<std::size_t>(face)] =
      PairBetween(edgePoints.Of(edgeIds[edges[0]]), edgePoints.Of(edgeIds[edges[1]]));
  }
  if (std::any_of(pairs.begin(), pairs.end(), [](const PointPair & pair) { return pair[0] == pair[1]; }))
  {
    throw CertificateError("a face of the core has no two nearest boundary vertices; please report this input");
  }
  return pairs;
}

void
AddPairsAround(std::span<const std::uint32_t> points, std::vector<PointPair> & pairs)
{
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const std::uint32_t p = points[i];
    const std::uint32_t q = points[(i + 1) % points.size()];
    if (p != q)
    {
      pairs.push_back({ std::min(p, q), std::max(p, q) });
    }
  }
}

VertexPairs::VertexPairs(const MedialComplex &         core,
                         const EdgePoints &            edgePoints,
                         const CellComplex &           cells,
                         std::span<const ElementIndex> vertexIds,
                         std::span<const ElementIndex> edgeIds)
{
  m_FacePairs = PairsOfFaces(edgePoints, cells, edgeIds);
  std::vector<char>                               onFace(cells.edges.size(), 0);
  std::vector<std::pair<ElementIndex, PointPair>> loose; // of vertices on no face, or not on faces alone
  std::vector<PointPair>                          around;
  const auto                                      addAround = [&](std::size_t edge, std::size_t vertex) {
    around.clear();
    AddPairsAround(edgePoints.Of(edge), around);
    for (const PointPair & pair : around)
    {
      loose.emplace_back(static_cast<ElementIndex>(vertex), pair);
    }
  };
  // Counted first, then where the pairs of each vertex begin.
  m_Offsets.assign(cells.vertexCount + 1, 0);
  for (std::size_t face = 0; face < cells.FaceCount(); ++face)
  {
    for (const ElementIndex edge : cells.FaceEdges(face))
    {
      onFace[edge] = 1;
    }
    for (const ElementIndex corner : cells.FaceVertices(face))
    {
      ++m_Offsets[corner + 1];
    }
  }
  for (std::size_t edge = 0; edge < onFace.size(); ++edge)
  {
    if (onFace[edge] == 0)
    {
      m_LooseEdges.push_back(static_cast<ElementIndex>(edge));
      for (const ElementIndex end : cells.edges[edge])
      {
        addAround(edgeIds[edge], end);
      }
    }
  }
  for (const auto & [vertex, pair] : loose)
  {
    ++m_Offsets[vertex + 1];
  }
  // A vertex of its own, as of a ball: what was nearest to it and its edges.
  std::vector<ElementIndex> alone; // by its place in the core, one more than here
  for (std::size_t vertex = 0; vertex < cells.vertexCount; ++vertex)
  {
    if (m_Offsets[vertex + 1] == 0)
    {
      alone.resize(core.cells.vertexCount, 0);
      alone[vertexIds[vertex]] = static_cast<ElementIndex>(vertex + 1);
    }
  }
  for (std::size_t edge = 0; edge < core.cells.edges.size() && !alone.empty(); ++edge)
  {
    for (const ElementIndex end : core.cells.edges[edge])
    {
      if (alone[end] != 0)
      {
        const std::size_t before = loose.size();
        addAround(edge, alone[end] - 1);
        m_Offsets[alone[end]] += loose.size() - before;
      }
    }
  }
  std::partial_sum(m_Offsets.begin(), m_Offsets.end(), m_Offsets.begin());
  m_Pairs.resize(m_Offsets.back());
  std::vector<std::uint64_t> next(m_Offsets.begin(), m_Offsets.end() - 1);
  for (std::size_t face = 0; face < cells.FaceCount(); ++face)
  {
    for (const ElementIndex corner : cells.FaceVertices(face))
    {
      m_Pairs[next[corner]++] = m_FacePairs[face];
    }
  }
  for (const auto & [vertex, pair] : loose)
  {
    m_Pairs[next[vertex]++] = pair;
  }
  // Each pair once.
  std::size_t kept = 0;
  for (std::size_t vertex = 0; vertex < cells.vertexCount; ++vertex)
  {
    const auto first = m_Pairs.begin() + static_cast<std::ptrdiff_t>(m_Offsets[vertex]);
    const auto last = m_Pairs.begin() + static_cast<std::ptrdiff_t>(next[vertex]);
    std::sort(first, last);
    m_Offsets[vertex] = kept;
    const auto end = std::unique_copy(first, last, m_Pairs.begin() + static_cast<std::ptrdiff_t>(kept));
    kept = static_cast<std::size_t>(end - m_Pairs.begin());
  }
  m_Offsets.back() = kept;
  m_Pairs.resize(kept);
}

} // namespace voxelcore
