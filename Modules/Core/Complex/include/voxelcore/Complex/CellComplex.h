#pragma once
// Cell complexes of dimension 0 to 2 as flat arrays.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace voxelcore
{

/** Index of a vertex, an edge or a face; up to 2^32 - 2 of each. */
using ElementIndex = std::uint32_t;

/** Vertices 0 .. vertexCount-1, edges, and polygonal faces. Face f has the corners
 *  faceVertices[faceOffsets[f] .. faceOffsets[f+1]) in cyclic order and, in the same places, the edges from each
 *  corner to the next. No two edges have the same ends, no two faces the same corners. Where a complex waits to be
 *  pruned corners may be missing, which the edges tell. */
struct CellComplex
{
  std::size_t                              vertexCount = 0;
  std::vector<std::array<ElementIndex, 2>> edges;            ///< smaller index first
  std::vector<std::uint64_t>               faceOffsets{ 0 }; ///< faces + 1 entries
  std::vector<ElementIndex>                faceVertices;     ///< corners, cyclic
  std::vector<ElementIndex>                faceEdges;        ///< faceEdges[i] joins corner i and the next

  std::size_t
  FaceCount() const
  {
    return faceOffsets.size() - 1;
  }
  bool
  HasCorners() const
  {
    return faceVertices.size() == faceEdges.size();
  }
  std::span<const ElementIndex>
  FaceVertices(std::size_t face) const
  {
    return { faceVertices.data() + faceOffsets[face], faceVertices.data() + faceOffsets[face + 1] };
  }
  std::span<const ElementIndex>
  FaceEdges(std::size_t face) const
  {
    return { faceEdges.data() + faceOffsets[face], faceEdges.data() + faceOffsets[face + 1] };
  }
};

/** The cofaces of an element, the elements one dimension up that it bounds: how many there are (left), and their
 *  indices by exclusive or, which is the index of one alone. */
struct Cofaces
{
  ElementIndex count = 0;
  ElementIndex exclusiveOr = 0;

  void
  Add(ElementIndex coface)
  {
    ++count;
    exclusiveOr ^= coface;
  }
  void
  Remove(ElementIndex coface)
  {
    --count;
    exclusiveOr ^= coface;
  }
};

/** The corners of a face by its edges: each is what an edge shares with the one before. */
void
FindCorners(const CellComplex & complex, std::size_t face, ElementIndex * corners);

/** The edges at each vertex. */
std::vector<Cofaces>
CountVertexCofaces(const CellComplex & complex);

/** The faces at each edge. */
std::vector<Cofaces>
CountEdgeCofaces(const CellComplex & complex);

} // namespace voxelcore
