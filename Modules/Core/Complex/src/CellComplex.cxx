#include "voxelcore/Complex/CellComplex.h"

namespace voxelcore
{

void
FindCorners(const CellComplex & complex, std::size_t face, ElementIndex * corners)
{
  const auto   sides = complex.FaceEdges(face);
  const auto * before = &complex.edges[sides.back()];
  for (const ElementIndex side : sides)
  {
    const auto & ends = complex.edges[side];
    *corners++ = ends[0] == (*before)[0] || ends[0] == (*before)[1] ? ends[0] : ends[1];
    before = &ends;
  }
}

std::vector<Cofaces>
CountVertexCofaces(const CellComplex & complex)
{
  std::vector<Cofaces> cofaces(complex.vertexCount);
  for (std::size_t edge = 0; edge < complex.edges.size(); ++edge)
  {
    for (const ElementIndex vertex : complex.edges[edge])
    {
      cofaces[vertex].Add(static_cast<ElementIndex>(edge));
    }
  }
  return cofaces;
}

std::vector<Cofaces>
CountEdgeCofaces(const CellComplex & complex)
{
  constexpr std::size_t ahead = 32; // sides
  std::vector<Cofaces>  cofaces(complex.edges.size());
  const ElementIndex *  sides = complex.faceEdges.data();
  for (std::size_t face = 0; face < complex.FaceCount(); ++face)
  {
    for (std::size_t side = complex.faceOffsets[face]; side < complex.faceOffsets[face + 1]; ++side)
    {
      if (side + ahead < complex.faceEdges.size())
      {
        __builtin_prefetch(&cofaces[sides[side + ahead]], 1);
      }
      cofaces[sides[side]].Add(static_cast<ElementIndex>(face));
    }
  }
  return cofaces;
}

} // namespace voxelcore
