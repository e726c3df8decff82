#include "voxelcore/SimplePairCollapse.h"

#include "voxelcore/BucketQueue.h"
#include "voxelcore/SideBySide.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace voxelcore
{

namespace
{

struct Pair
{
  double        measure;       // of e
  double        cofaceMeasure; // of f
  std::uint32_t isEdge;        // dimension of e: 0 vertex, 1 edge
  ElementIndex  element;       // e

  double
  Key() const
  {
    return measure;
  }
  friend bool
  operator<(const Pair & a, const Pair & b)
  {
    if (a.measure != b.measure)
    {
      return a.measure < b.measure;
    }
    if (a.cofaceMeasure != b.cofaceMeasure)
    {
      return a.cofaceMeasure < b.cofaceMeasure;
    }
    return a.isEdge != b.isEdge ? a.isEdge < b.isEdge : a.element < b.element;
  }
};

} // namespace

SimplePairCollapse::SimplePairCollapse(const CellComplex &     complex,
                                       std::span<const double> vertexMeasure,
                                       std::span<const double> edgeMeasure,
                                       std::span<const double> faceMeasure)
  : m_Complex(&complex)
  , m_VertexMeasure(vertexMeasure)
  , m_EdgeMeasure(edgeMeasure)
  , m_FaceMeasure(faceMeasure)
  , m_Live{ std::vector<std::uint8_t>(complex.vertexCount, 1),
            std::vector<std::uint8_t>(complex.edges.size(), 1),
            std::vector<std::uint8_t>(complex.FaceCount(), 1) }
{
  RunBoth(
    complex.FaceCount() > 10000,
    [&] { m_EdgeCofaces = CountEdgeCofaces(complex); },
    [&] { m_VertexCofaces = CountVertexCofaces(complex); });
}

void
SimplePairCollapse::CollapseBelow(double threshold, const ProgressCallback & progress)
{
  double least = HUGE_VAL;
  double greatest = -HUGE_VAL;
  for (const std::span<const double> measures : { m_VertexMeasure, m_EdgeMeasure })
  {
    for (const double measure : measures)
    {
      least = std::min(least, measure);
      greatest = std::max(greatest, measure);
    }
  }
  BucketQueue<Pair> pairs(std::max(least, std::numeric_limits<double>::lowest()),
                          std::min({ greatest, threshold, std::numeric_limits<double>::max() }));
  // A vertex in one edge is in no face, as a face would need two edges there; so cofaces one dimension up suffice.
  const auto offerVertex = [&](ElementIndex vertex) {
    if (m_VertexCofaces[vertex].count == 1 && m_VertexMeasure[vertex] < threshold)
    {
      const double coface = m_EdgeMeasure[m_VertexCofaces[vertex].exclusiveOr];
      if (coface < threshold)
      {
        pairs.Push({ m_VertexMeasure[vertex], coface, 0, vertex });
      }
    }
  };
  const auto offerEdge = [&](ElementIndex edge) {
    if (m_EdgeCofaces[edge].count == 1 && m_EdgeMeasure[edge] < threshold)
    {
      const double coface = m_FaceMeasure[m_EdgeCofaces[edge].exclusiveOr];
      if (coface < threshold)
      {
        pairs.Push({ m_EdgeMeasure[edge], coface, 1, edge });
      }
    }
  };
  const auto dropEdge = [&](ElementIndex edge) {
    m_Live.edges[edge] = 0;
    for (const ElementIndex vertex : m_Complex->edges[edge])
    {
      m_VertexCofaces[vertex].Remove(edge);
      if (m_Live.vertices[vertex])
      {
        offerVertex(vertex);
      }
    }
  };

  for (std::size_t vertex = 0; vertex < m_VertexCofaces.size(); ++vertex)
  {
    if (m_Live.vertices[vertex])
    {
      offerVertex(static_cast<ElementIndex>(vertex));
    }
  }
  for (std::size_t edge = 0; edge < m_EdgeCofaces.size(); ++edge)
  {
    if (m_Live.edges[edge])
    {
      offerEdge(static_cast<ElementIndex>(edge));
    }
  }

  // Removing in order of measure jumps about in memory: what the pairs ahead will ask for is fetched step by step.
  const auto fetch = [&] {
    if (const Pair * pair = pairs.Ahead(24); pair != nullptr && pair->isEdge)
    {
      __builtin_prefetch(&m_EdgeCofaces[pair->element], 1);
      __builtin_prefetch(&m_Live.edges[pair->element], 1);
      __builtin_prefetch(&m_Complex->edges[pair->element]);
    }
    const auto faceOf = [&](const Pair * pair) {
      const bool simple = pair != nullptr && pair->isEdge && m_EdgeCofaces[pair->element].count == 1;
      return simple ? std::optional(m_EdgeCofaces[pair->element].exclusiveOr) : std::nullopt;
    };
    if (const auto face = faceOf(pairs.Ahead(16)))
    {
      __builtin_prefetch(&m_Complex->faceOffsets[*face]);
      __builtin_prefetch(&m_Live.faces[*face], 1);
    }
    if (const auto face = faceOf(pairs.Ahead(8)))
    {
      __builtin_prefetch(&m_Complex->faceEdges[m_Complex->faceOffsets[*face]]);
    }
    if (const auto face = faceOf(pairs.Ahead(4)))
    {
      for (const ElementIndex edge : m_Complex->FaceEdges(*face))
      {
        __builtin_prefetch(&m_EdgeCofaces[edge], 1);
        __builtin_prefetch(&m_EdgeMeasure[edge]);
      }
    }
  };

  std::size_t count = 0;
  while (pairs.Prepare())
  {
    if ((count++ & 0xFFFFU) == 0)
    {
      ReportProgress(progress, "prune", 0.0);
    }
    fetch();
    const Pair pair = pairs.Pop();
    if (pair.isEdge)
    {
      // Its face may have gone with another of its edges in the meantime.
      if (!m_Live.edges[pair.element] || m_EdgeCofaces[pair.element].count != 1)
      {
        continue;
      }
      const ElementIndex face = m_EdgeCofaces[pair.element].exclusiveOr;
      m_Live.faces[face] = 0;
      for (const ElementIndex edge : m_Complex->FaceEdges(face))
      {
        m_EdgeCofaces[edge].Remove(face);
        if (edge != pair.element)
        {
          offerEdge(edge);
        }
      }
      dropEdge(pair.element);
    }
    else
    {
      if (!m_Live.vertices[pair.element] || m_VertexCofaces[pair.element].count != 1)
      {
        continue;
      }
      m_Live.vertices[pair.element] = 0;
      dropEdge(m_VertexCofaces[pair.element].exclusiveOr);
    }
  }
}

CellComplex
ExtractLive(const CellComplex &         complex,
            const LiveElements &        live,
            std::vector<ElementIndex> & vertexIds,
            std::vector<ElementIndex> & edgeIds,
            std::vector<ElementIndex> & faceIds)
{
  const auto collect = [](const std::vector<std::uint8_t> & flags, std::vector<ElementIndex> & ids) {
    ids.clear();
    ids.reserve(static_cast<std::size_t>(std::count(flags.begin(), flags.end(), 1)));
    std::vector<ElementIndex> renumbered(flags.size(), 0);
    for (std::size_t element = 0; element < flags.size(); ++element)
    {
      if (flags[element])
      {
        renumbered[element] = static_cast<ElementIndex>(ids.size());
        ids.push_back(static_cast<ElementIndex>(element));
      }
    }
    return renumbered;
  };
  const auto vertexNumbers = collect(live.vertices, vertexIds);
  const auto edgeNumbers = collect(live.edges, edgeIds);
  collect(live.faces, faceIds);

  CellComplex result;
  result.vertexCount = vertexIds.size();
  result.edges.reserve(edgeIds.size());
  for (const ElementIndex edge : edgeIds)
  {
    const auto & ends = complex.edges[edge];
    result.edges.push_back({ vertexNumbers[ends[0]], vertexNumbers[ends[1]] });
  }
  result.faceOffsets.reserve(faceIds.size() + 1);
  std::uint64_t corners = 0;
  for (const ElementIndex face : faceIds)
  {
    corners += complex.faceOffsets[face + 1] - complex.faceOffsets[face];
    result.faceOffsets.push_back(corners);
  }
  result.faceVertices.reserve(corners);
  result.faceEdges.reserve(corners);
  for (const ElementIndex face : faceIds)
  {
    for (const ElementIndex vertex : complex.FaceVertices(face))
    {
      result.faceVertices.push_back(vertexNumbers[vertex]);
    }
    for (const ElementIndex edge : complex.FaceEdges(face))
    {
      result.faceEdges.push_back(edgeNumbers[edge]);
    }
  }
  return result;
}

} // namespace voxelcore
