#pragma once
// Tetrahedra as an engine that does not merge gives them, and how they become cells.

#include "voxelcore/Delaunay/DelaunayCells.h"

#include <functional>

namespace voxelcore
{

/** A Delaunay tetrahedralization. Corners refer to points; either orientation. */
struct Tetrahedra
{
  std::vector<std::array<std::uint32_t, 4>> corners;
  /** The tetrahedron opposite to each corner; kOutside where there is none. */
  std::vector<std::array<std::uint32_t, 4>> neighbours;
};

/** The three corners of the face opposite to corner i, counter-clockwise from outside in a positive tetrahedron. */
inline constexpr std::size_t tetrahedronFaces[4][3] = { { 1, 2, 3 }, { 0, 3, 2 }, { 0, 1, 3 }, { 0, 2, 1 } };

/** Names the facet that a face between an inside and an outside tetrahedron belongs to: faces of one cell with the
 *  same name make one polygon. Gets the tetrahedron, the number of the face and its points. */
using NameWall =
  std::function<std::uint64_t(std::size_t tetrahedron, std::size_t face, const std::array<std::uint32_t, 3> & points)>;

/** Unites cospherical tetrahedra among those flagged inside into cells with polygonal facets, not yet in canonical
 *  order. Facets towards tetrahedra that are not inside get kOutside as second cell, and their name is appended to
 *  `walls` in the order in which these facets stand in the result. */
DelaunayCells
MergeTetrahedra(Tetrahedra                        tetrahedra,
                const std::vector<std::uint8_t> & inside,
                const std::vector<LatticePoint> & points,
                const SpacingWeights &            weights,
                const NameWall &                  nameWall,
                std::vector<std::uint64_t> *      walls = nullptr);

} // namespace voxelcore
