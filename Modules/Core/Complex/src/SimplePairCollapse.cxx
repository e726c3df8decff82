#include "voxelcore/Complex/SimplePairCollapse.h"

#include "PairRemoval.h"

#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Base/SpentMemory.h"

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

namespace
{

void
MakeCorners(CellComplex & complex)
{
  complex.faceVertices.resize(complex.faceEdges.size());
  for (std::size_t face = 0; face < complex.FaceCount(); ++face)
  {
    FindCorners(complex, face, complex.faceVertices.data() + complex.faceOffsets[face]);
  }
}

/** `to` may be `from` itself: each element then moves to where it was or before that. */
void
TakeLive(const CellComplex &         from,
         const LiveElements &        live,
         CellComplex &               to,
         std::vector<ElementIndex> & vertexIds,
         std::vector<ElementIndex> & edgeIds,
         std::vector<ElementIndex> & faceIds)
{
  const bool                 worthIt = from.FaceCount() > 10000;
  const bool                 hasCorners = from.HasCorners();
  std::vector<ElementIndex>  vertexNumbers;
  std::vector<ElementIndex>  edgeNumbers;
  std::vector<std::uint64_t> offsets{ 0 };
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
      offsets.reserve(faceIds.size() + 1);
      std::uint64_t corners = 0;
      for (const ElementIndex face : faceIds)
      {
        corners += from.faceOffsets[face + std::size_t{ 1 }] - from.faceOffsets[face];
        offsets.push_back(corners);
      }
    });
  const auto fit = [](auto & values, std::size_t count) {
    if (values.size() < count)
    {
      values.resize(count);
    }
  };
  const auto takeSides = [&](const auto & sides, const auto & numbers, auto & taken) {
    fit(taken, offsets.back());
    std::size_t at = 0;
    for (const ElementIndex face : faceIds)
    {
      for (std::uint64_t i = from.faceOffsets[face]; i < from.faceOffsets[face + std::size_t{ 1 }]; ++i)
      {
        taken[at++] = numbers[sides[i]];
      }
    }
    CutShort(taken, offsets.back());
  };
  RunBoth(
    worthIt,
    [&] {
      fit(to.edges, edgeIds.size());
      for (std::size_t i = 0; i < edgeIds.size(); ++i)
      {
        const auto ends = from.edges[edgeIds[i]];
        to.edges[i] = { vertexNumbers[ends[0]], vertexNumbers[ends[1]] };
      }
      CutShort(to.edges, edgeIds.size());
      if (hasCorners)
      {
        takeSides(from.faceVertices, vertexNumbers, to.faceVertices);
      }
    },
    [&] { takeSides(from.faceEdges, edgeNumbers, to.faceEdges); });
  to.faceOffsets = std::move(offsets);
  to.vertexCount = vertexIds.size();
  if (!hasCorners)
  {
    MakeCorners(to);
  }
}

} // namespace

CellComplex
ExtractLive(const CellComplex &         complex,
            const LiveElements &        live,
            std::vector<ElementIndex> & vertexIds,
            std::vector<ElementIndex> & edgeIds,
            std::vector<ElementIndex> & faceIds)
{
  CellComplex result;
  TakeLive(complex, live, result, vertexIds, edgeIds, faceIds);
  return result;
}

void
KeepLive(CellComplex &               complex,
         const LiveElements &        live,
         std::vector<ElementIndex> & vertexIds,
         std::vector<ElementIndex> & edgeIds,
         std::vector<ElementIndex> & faceIds)
{
  TakeLive(complex, live, complex, vertexIds, edgeIds, faceIds);
}

} // namespace voxelcore
