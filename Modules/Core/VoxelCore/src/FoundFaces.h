#pragma once
// The sides of a core's faces, found in the facets of its cells.

#include "FacetPolygons.h"

#include "voxelcore/Complex/FaceName.h"
#include "voxelcore/Lattice/LatticePoint.h"
#include "voxelcore/Lattice/SpacingWeights.h"

namespace voxelcore
{

using CoreEdges = std::vector<std::array<ElementIndex, 2>>;

/** A core edge as one side of a face, the dual of one facet around the face's Delaunay edge (p, q), p < q: twice the
 *  edge, plus 1 when the face, seen against p -> q, passes it from end 0 to end 1. */
using Turn = std::uint32_t;

/** Where a side begins. */
inline ElementIndex
Tail(Turn turn, const CoreEdges & edges)
{
  return edges[turn >> 1][1 - (turn & 1U)];
}

/** Where a side ends. */
inline ElementIndex
Head(Turn turn, const CoreEdges & edges)
{
  return edges[turn >> 1][turn & 1U];
}

/** More sides than any face has. */
inline constexpr int         kSidesBits = 28;
inline constexpr std::size_t kMostSides = std::size_t{ 1 } << kSidesBits;

/** A face as it is found: its sides follow those of the face found before. */
struct FoundFace
{
  double        lambda; ///< mm
  FaceName      name;
  std::uint32_t sides;
};

/** All sides, face by face, each face's in turn from its smallest corner on. */
struct FoundFaces
{
  std::vector<Turn>      turns;
  std::vector<FoundFace> faces;
};

/** The faces of the core with these edges, polygon i being that of the facet dual to edge i; in no order of theirs.
 *  Polygons and points are as MeasureCells() leaves them, and are given back on the way.
 *  \throws CertificateError when the facets around an edge do not close. */
FoundFaces
FindFaces(FacetPolygons             polygons,
          std::vector<LatticePoint> sortedPoints,
          const SpacingWeights &    weights,
          const CoreEdges &         edges);

} // namespace voxelcore
