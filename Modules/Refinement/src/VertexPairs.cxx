#include "VertexPairs.h"

#include "voxelcore/Error.h"

#include <algorithm>

namespace voxelcore
{

namespace
{

// The two boundary vertices that two sides of a face share: facets of a convex cell meet in an edge.
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
    throw CertificateError("a face of the core has no two nearest boundary vertices; please report this input");
  }
  return { std::min(pair[0], pair[1]), std::max(pair[0], pair[1]) };
}

} // namespace

std::vector<PointPair>
PairsOfFaces(const EdgePoints & edgePoints, const CellComplex & cells, std::span<const ElementIndex> edgeIds)
{
  std::vector<PointPair> pairs(cells.FaceCount());
  for (std::size_t face = 0; face < pairs.size(); ++face)
  {
    const auto edges = cells.FaceEdges(face);
    pairs[face] = PairBetween(edgePoints.Of(edgeIds[edges[0]]), edgePoints.Of(edgeIds[edges[1]]));
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
  std::vector<std::vector<PointPair>> ofVertex(cells.vertexCount);
  std::vector<char>                   onFace(cells.edges.size(), 0);
  m_FacePairs = PairsOfFaces(edgePoints, cells, edgeIds);
  for (std::size_t face = 0; face < cells.FaceCount(); ++face)
  {
    for (const ElementIndex edge : cells.FaceEdges(face))
    {
      onFace[edge] = 1;
    }
    for (const ElementIndex corner : cells.FaceVertices(face))
    {
      ofVertex[corner].push_back(m_FacePairs[face]);
    }
  }
  for (std::size_t edge = 0; edge < onFace.size(); ++edge)
  {
    if (onFace[edge] == 0)
    {
      m_LooseEdges.push_back(static_cast<ElementIndex>(edge));
      for (const ElementIndex end : cells.edges[edge])
      {
        AddPairsAround(edgePoints.Of(edgeIds[edge]), ofVertex[end]);
      }
    }
  }
  // A vertex of its own, as of a ball: what was nearest to it and its edges.
  std::vector<std::uint8_t> alone(core.cells.vertexCount, 0);
  bool                      any = false;
  for (std::size_t vertex = 0; vertex < ofVertex.size(); ++vertex)
  {
    if (ofVertex[vertex].empty())
    {
      alone[vertexIds[vertex]] = 1;
      any = true;
    }
  }
  if (any)
  {
    std::vector<ElementIndex> place(core.cells.vertexCount, 0);
    for (std::size_t vertex = 0; vertex < vertexIds.size(); ++vertex)
    {
      place[vertexIds[vertex]] = static_cast<ElementIndex>(vertex);
    }
    for (std::size_t edge = 0; edge < core.cells.edges.size(); ++edge)
    {
      for (const ElementIndex end : core.cells.edges[edge])
      {
        if (alone[end] != 0)
        {
          AddPairsAround(edgePoints.Of(edge), ofVertex[place[end]]);
        }
      }
    }
  }
  for (std::vector<PointPair> & pairs : ofVertex)
  {
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    m_Pairs.insert(m_Pairs.end(), pairs.begin(), pairs.end());
    m_Offsets.push_back(m_Pairs.size());
  }
}

} // namespace voxelcore
