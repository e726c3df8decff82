#pragma once
// The points fire runs between, and the sectors of faces around each of them.


#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/VoxelCore/MedialComplex.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace voxelcore
{

/** Points 0 .. vertexCount-1 are the vertices, then come the sample points of each edge in turn.
 *
 *  A sector is a set of faces around a point that hang together across edges with exactly two faces (a fan of the
 *  point's link between seams). Fire that comes into a sector burns all of it at once. Sectors of vertices are numbered
 *  vertex by vertex, then come those of samples, edge by edge: a row of one sector per sample for both faces of an edge
 *  with two, a row for each face where there are three or more, so that a face finds the sectors of an edge side by
 *  side. A point without faces has none. `corner` numbers positions in CellComplex::faceVertices and faceEdges, and
 *  `sides`.
 *
 *  Positions and radii of samples are computed when they are asked for: that is less work than fetching them. */
struct BurnNetwork
{
  /** Where an edge begins in other arrays; the next edge says where it ends. */
  struct EdgeFirst
  {
    std::uint32_t point;  ///< its first sample
    std::uint32_t sector; ///< the first of its samples' sectors
    std::uint32_t face;   ///< in edgeFaces
  };

  /** The sectors that hold a face: of a corner [0], of the first sample on the edge that begins there [1]. */
  struct Side
  {
    std::array<std::uint32_t, 2> sector;
  };

  struct FaceCorner
  {
    std::uint32_t corner;
    std::uint32_t face;
  };

  /** A sector of a vertex that ends in a seam, an edge with three faces or more: which of the vertex' sectors it is,
   *  with the bit below where the next one ends in another seam. */
  using SeamEnd = std::uint32_t;

  static constexpr SeamEnd kLastAtSeam = 0x80000000U;

  /** `complex` must outlive the object. \throws InputError above 2^32 - 2 points or sectors. */
  BurnNetwork(const MedialComplex & complex, double sampling);

  const MedialComplex *      m_Complex;
  const CellComplex *        m_Cells;
  std::vector<Side>          sides;               ///< per corner
  std::vector<std::uint32_t> vertexFaceOffsets;   ///< vertices + 1 entries
  std::vector<std::uint32_t> vertexFaces;         ///< faces at each vertex
  std::vector<EdgeFirst>     edgeFirst;           ///< edges + 1 entries
  std::vector<std::uint32_t> edgeFaces;           ///< faces at each edge
  std::vector<std::uint32_t> pointEdge;           ///< per sample point (from vertexCount on) its edge
  std::vector<std::uint32_t> vertexSectorOffsets; ///< vertices + 1 entries
  std::vector<std::uint8_t>  openSector;          ///< per sector of a vertex: 1 when it ends in an edge with one face
  std::vector<std::uint32_t> seamEndOffsets;      ///< vertices + 1 entries
  std::vector<SeamEnd>       seamEnds;            ///< at each vertex with several sectors, edge by edge

  /** Gives back what only ignition asks for. */
  void
  EndIgnition();

  /** Gives back what only fire asks for. */
  void
  EndFire();

  std::size_t
  PointCount() const
  {
    return edgeFirst.back().point;
  }

  std::size_t
  SectorCount() const
  {
    return edgeFirst.back().sector;
  }

  std::uint32_t
  EdgeFaceCount(ElementIndex edge) const
  {
    return edgeFirst[edge + std::size_t{ 1 }].face - edgeFirst[edge].face;
  }

  std::uint32_t
  SampleCount(ElementIndex edge) const
  {
    return edgeFirst[edge + std::size_t{ 1 }].point - edgeFirst[edge].point;
  }

  /** Where the sectors of a point are. */
  struct SectorRange
  {
    std::uint32_t first;
    std::uint32_t count;
    std::uint32_t stride;
  };

  SectorRange
  Sectors(std::uint32_t point) const
  {
    if (point < m_Cells->vertexCount)
    {
      const std::uint32_t first = vertexSectorOffsets[point];
      return { first, vertexSectorOffsets[point + std::size_t{ 1 }] - first, 1 };
    }
    const ElementIndex  edge = pointEdge[point - m_Cells->vertexCount];
    const std::uint32_t faces = EdgeFaceCount(edge);
    return { edgeFirst[edge].sector + point - edgeFirst[edge].point, faces >= 3 ? faces : 1, SampleCount(edge) };
  }

  /** Samples divide an edge from a to b evenly. */
  static Vector3
  SamplePosition(const Vector3 & a, const Vector3 & b, std::uint32_t rank, std::uint32_t count)
  {
    const double t = static_cast<double>(rank + 1) / (count + 1);
    const double s = 1 - t;
    return { s * a[0] + t * b[0], s * a[1] + t * b[1], s * a[2] + t * b[2] };
  }

  /** All points of an edge have the same nearest boundary vertices; this is the distance to one of them (Stewart).
   *  `t` of the way from an end with radius `ra` to one with radius `rb`; `squared`: the length of the edge. */
  static double
  RadiusBetween(double ra, double rb, double squared, double t)
  {
    const double s = 1 - t;
    return std::sqrt(std::max(0.0, s * (ra * ra) + t * (rb * rb) - s * t * squared));
  }

  double
  SampleRadius(ElementIndex edge, std::uint32_t rank) const;

  Vector3
  Position(std::uint32_t point) const
  {
    if (point < m_Cells->vertexCount)
    {
      return m_Complex->positions[point];
    }
    const ElementIndex edge = pointEdge[point - m_Cells->vertexCount];
    const auto &       ends = m_Cells->edges[edge];
    return SamplePosition(m_Complex->positions[ends[0]],
                          m_Complex->positions[ends[1]],
                          point - edgeFirst[edge].point,
                          SampleCount(edge));
  }

  /** Where a vertex of a face is among its corners. */
  FaceCorner
  CornerAt(std::uint32_t face, ElementIndex vertex) const
  {
    return { PlaceOf(m_Cells->faceVertices, face, vertex), face };
  }

  /** The corner of a face in which one of its edges begins. */
  FaceCorner
  SideAt(std::uint32_t face, ElementIndex edge) const
  {
    return { PlaceOf(m_Cells->faceEdges, face, edge), face };
  }

  /** The side of the same face that ends in this corner. */
  std::uint32_t
  SideBefore(const FaceCorner & at) const
  {
    const std::uint64_t first = m_Cells->faceOffsets[at.face];
    return static_cast<std::uint32_t>(at.corner == first ? m_Cells->faceOffsets[at.face + std::size_t{ 1 }] - 1
                                                         : at.corner - 1);
  }

  /** The next corner of the same face. */
  std::uint32_t
  CornerAfter(const FaceCorner & at) const
  {
    const std::uint64_t end = m_Cells->faceOffsets[at.face + std::size_t{ 1 }];
    return static_cast<std::uint32_t>(at.corner + 1 == end ? m_Cells->faceOffsets[at.face] : at.corner + 1);
  }

private:
  std::uint32_t
  PlaceOf(const std::vector<ElementIndex> & elements, std::uint32_t face, ElementIndex element) const
  {
    const auto begin = elements.begin();
    const auto first = begin + static_cast<std::ptrdiff_t>(m_Cells->faceOffsets[face]);
    const auto last = begin + static_cast<std::ptrdiff_t>(m_Cells->faceOffsets[face + std::size_t{ 1 }]);
    return static_cast<std::uint32_t>(std::find(first, last, element) - begin);
  }

  void
  BuildIncidence();
  void
  PlaceSamples(double sampling);
  struct Fan;

  /** Sectors of some vertices, numbered from 0 on. */
  struct SectorPart
  {
    std::size_t               firstVertex;
    std::size_t               lastVertex;
    std::vector<std::uint8_t> open;
    std::vector<SeamEnd>      seamEnds;
  };

  SectorPart
  FindSectors(std::size_t firstVertex, std::size_t lastVertex);
  static void
  FindSeamEnds(Fan & fan, std::uint32_t firstSector, std::vector<SeamEnd> & seamEnds);
  void
  BuildSectors();
  void
  BuildSides();
};

} // namespace voxelcore
