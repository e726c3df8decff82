#pragma once
// The points fire runs between, and the sectors of faces around each of them.

#include "voxelcore/MedialComplex.h"

#include <array>
#include <cstdint>
#include <vector>

namespace voxelcore
{

/** Points 0 .. vertexCount-1 are the vertices, then come the sample points of each edge in turn.
 *
 *  A sector is a set of faces around a point that hang together across edges with exactly two faces (a fan of the
 *  point's link between seams). Fire that comes into a sector burns all of it at once. Sectors are numbered point by
 *  point; a point without faces has none. `corner` numbers positions in CellComplex::faceVertices and faceEdges. */
struct BurnNetwork
{
  /** \throws InputError above 2^32 - 2 points or sectors. */
  BurnNetwork(const MedialComplex & complex, double sampling);

  const CellComplex *                m_Cells;
  std::vector<std::uint32_t>         cornerFace;
  std::vector<std::uint32_t>         vertexCornerOffsets; ///< vertices + 1 entries
  std::vector<std::uint32_t>         vertexCorners;       ///< corners at each vertex
  std::vector<std::uint32_t>         edgeSideOffsets;     ///< edges + 1 entries
  std::vector<std::uint32_t>         edgeSides;           ///< corners that begin this edge, face by face
  std::vector<std::uint32_t>         edgePointOffsets;    ///< edges + 1 entries: the first point of each edge
  std::vector<std::uint32_t>         pointEdge;           ///< per sample point (from vertexCount on) its edge
  std::vector<std::array<double, 3>> positions;           ///< of sample points, mm
  std::vector<double>                radius;              ///< of all points, mm
  std::vector<std::uint32_t>         sectorOffsets;       ///< points + 1 entries
  std::vector<std::uint8_t>          openSector;          ///< 1 when the sector ends in an edge with one face
  std::vector<std::uint32_t>         cornerSector;        ///< per corner: its vertex' sector that holds its face
  std::vector<std::uint32_t>         sideSector;          ///< per corner: rank of its face's sector on its edge

  std::uint32_t
  EdgeFaceCount(ElementIndex edge) const
  {
    return edgeSideOffsets[edge + std::size_t{ 1 }] - edgeSideOffsets[edge];
  }

  /** The side of the same face that ends in this corner. */
  std::uint32_t
  SideBefore(std::uint32_t corner) const
  {
    const std::uint64_t first = m_Cells->faceOffsets[cornerFace[corner]];
    const std::uint64_t end = m_Cells->faceOffsets[cornerFace[corner] + std::size_t{ 1 }];
    return static_cast<std::uint32_t>(corner == first ? end - 1 : corner - 1);
  }

private:
  void
  BuildIncidence();
  void
  PlaceSamples(const MedialComplex & complex, double sampling);
  void
  BuildSectors();
};

} // namespace voxelcore
