#pragma once
// The vertices along the rims of sheets.

#include "voxelcore/Complex/CellComplex.h"
#include "voxelcore/Lattice/Vectors.h"

#include <array>
#include <span>
#include <vector>

namespace voxelcore
{

/** Of a complex of triangles the vertices where two edges of one triangle each meet, in their order, with the triangles
 *  there. */
class RimVertices
{
public:
  /** Of the triangles with a flag alone. */
  RimVertices(const CellComplex & cells, const std::vector<std::uint8_t> & faces);

  std::size_t
  Count() const
  {
    return m_Vertices.size();
  }
  ElementIndex
  Vertex(std::size_t i) const
  {
    return m_Vertices[i];
  }
  /** The other ends of its two edges of the rim. */
  const std::array<ElementIndex, 2> &
  Ends(std::size_t i) const
  {
    return m_Ends[i];
  }
  std::span<const ElementIndex>
  Faces(std::size_t i) const
  {
    return { m_Faces.data() + m_Offsets[i], m_Faces.data() + m_Offsets[i + 1] };
  }
  /** How many triangles have each edge. */
  const std::vector<ElementIndex> &
  FacesAtEdges() const
  {
    return m_FacesAtEdges;
  }

private:
  std::vector<ElementIndex>                m_FacesAtEdges;
  std::vector<ElementIndex>                m_Vertices;
  std::vector<std::array<ElementIndex, 2>> m_Ends;
  std::vector<std::size_t>                 m_Offsets;
  std::vector<ElementIndex>                m_Faces;
};

/** The cosine of the angle by which a line from a to b turns at v; 1 where it has no length. Places in mm. */
double
CosineOfTurn(const Vector3 & a, const Vector3 & v, const Vector3 & b);

/** Where a rim turns by more than 60 degrees it is torn: the cosine is less. */
inline constexpr double kTornRim = 0.5;

} // namespace voxelcore
