#include "voxelcore/SimplePairCollapse.h"

#include "PairRemoval.h"

#include "voxelcore/ParallelTasks.h"

#include <algorithm>

namespace voxelcore
{

namespace
{

void
CollectLive(const std::vector<std::uint8_t> & flags, std::vector<ElementIndex> & ids)
{
  ids.clear();
  ids.reserve(static_cast<std::size_t>(std::count(flags.begin(), flags.end(), 1)));
  for (std::size_t element = 0; element < flags.size(); ++element)
  {
    if (flags[element] != 0)
    {
      ids.push_back(static_cast<ElementIndex>(element));
    }
  }
}

// The place of each element among those collected; what is not there is not asked for.
std::vector<ElementIndex>
NumbersOf(const std::vector<ElementIndex> & ids, std::size_t count)
{
  std::vector<ElementIndex> numbers(count, 0);
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    numbers[ids[i]] = static_cast<ElementIndex>(i);
  }
  return numbers;
}

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
  RemovePairs({ *m_Complex, m_VertexMeasure, m_EdgeMeasure, m_FaceMeasure, m_Live, m_VertexCofaces, m_EdgeCofaces },
              threshold,
              progress);
}

CellComplex
ExtractLive(const CellComplex &         complex,
            const LiveElements &        live,
            std::vector<ElementIndex> & vertexIds,
            std::vector<ElementIndex> & edgeIds,
            std::vector<ElementIndex> & faceIds)
{
  const bool                worthIt = complex.FaceCount() > 10000;
  std::vector<ElementIndex> vertexNumbers;
  std::vector<ElementIndex> edgeNumbers;
  CellComplex               result;
  RunBoth(
    worthIt,
    [&] {
      CollectLive(live.edges, edgeIds);
      edgeNumbers = NumbersOf(edgeIds, live.edges.size());
    },
    [&] {
      CollectLive(live.vertices, vertexIds);
      vertexNumbers = NumbersOf(vertexIds, live.vertices.size());
      CollectLive(live.faces, faceIds);
      result.faceOffsets.reserve(faceIds.size() + 1);
      std::uint64_t corners = 0;
      for (const ElementIndex face : faceIds)
      {
        corners += complex.faceOffsets[face + 1] - complex.faceOffsets[face];
        result.faceOffsets.push_back(corners);
      }
    });
  result.vertexCount = vertexIds.size();
  RunBoth(
    worthIt,
    [&] {
      result.edges.reserve(edgeIds.size());
      for (const ElementIndex edge : edgeIds)
      {
        const auto & ends = complex.edges[edge];
        result.edges.push_back({ vertexNumbers[ends[0]], vertexNumbers[ends[1]] });
      }
      result.faceVertices.reserve(result.faceOffsets.back());
      for (const ElementIndex face : faceIds)
      {
        for (const ElementIndex vertex : complex.FaceVertices(face))
        {
          result.faceVertices.push_back(vertexNumbers[vertex]);
        }
      }
    },
    [&] {
      result.faceEdges.reserve(result.faceOffsets.back());
      for (const ElementIndex face : faceIds)
      {
        for (const ElementIndex edge : complex.FaceEdges(face))
        {
          result.faceEdges.push_back(edgeNumbers[edge]);
        }
      }
    });
  return result;
}

} // namespace voxelcore
