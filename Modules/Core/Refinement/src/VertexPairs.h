#pragma once
// Between which boundary vertices the elements of a part of a core lie.

#include "FootPoints.h"

#include "voxelcore/Refinement/Refinement.h"

#include <algorithm>
#include <span>
#include <vector>

namespace voxelcore
{

/** Of each face, part of a core's cells, the two boundary vertices that it lies between; `edgeIds` are the core's own.
 *  \throws CertificateError where a face has no two nearest boundary vertices. */
std::vector<PointPair>
PairsOfFaces(const EdgePoints & edgePoints, const CellComplex & cells, std::span<const ElementIndex> edgeIds);

/** All pairs in a row around a polygon or a set of points are added. */
void
AddPairsAround(std::span<const std::uint32_t> points, std::vector<PointPair> & pairs);

/** The pairs of a part of a core: of each face, and of each vertex those of its faces and loose edges, in order. */
class VertexPairs
{
public:
  VertexPairs() = default;

  /** `cells` are elements of `core`, its vertices and edges those of these indices.
   *  \throws CertificateError where a face has no two nearest boundary vertices. */
  VertexPairs(const MedialComplex &         core,
              const EdgePoints &            edgePoints,
              const CellComplex &           cells,
              std::span<const ElementIndex> vertexIds,
              std::span<const ElementIndex> edgeIds);

  std::span<const PointPair>
  Of(std::size_t vertex) const
  {
    return { m_Pairs.data() + m_Offsets[vertex], m_Pairs.data() + m_Offsets[vertex + 1] };
  }

  /** Where Of(vertex) begins in All(). */
  std::size_t
  First(std::size_t vertex) const
  {
    return m_Offsets[vertex];
  }

  /** Where a pair of a vertex is in All(). */
  std::size_t
  Find(std::size_t vertex, const PointPair & pair) const
  {
    const auto pairs = Of(vertex);
    const auto found = std::lower_bound(pairs.begin(), pairs.end(), pair);
    return First(vertex) + static_cast<std::size_t>(found - pairs.begin());
  }

  const std::vector<PointPair> &
  All() const
  {
    return m_Pairs;
  }

  const PointPair &
  OfFace(std::size_t face) const
  {
    return m_FacePairs[face];
  }

  /** Edges on no face. */
  const std::vector<ElementIndex> &
  LooseEdges() const
  {
    return m_LooseEdges;
  }

private:
  std::vector<PointPair>     m_FacePairs;
  std::vector<ElementIndex>  m_LooseEdges;
  std::vector<std::uint64_t> m_Offsets{ 0 };
  std::vector<PointPair>     m_Pairs;
};

} // namespace voxelcore
