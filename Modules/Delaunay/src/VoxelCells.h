#pragma once
// The smallest Delaunay cells: boundary vertices among the corners of one inside voxel, when they span space.

#include "CellHull.h"

#include <array>

namespace voxelcore
{

/** For each of the 256 sets of corners (corner c = x + 2 y + 4 z is bit c): its hull when it spans space. A facet that
 *  lies on a side of the voxel names it: 0 and 1 for x = 0 and 1, then y, then z; 6 for one that cuts through. */
struct VoxelCell
{
  bool                                   spansSpace = false;
  std::array<std::uint8_t, 4>            tetrahedron{}; ///< four corners not in one plane
  std::vector<std::vector<std::uint8_t>> facets;        ///< corners, counter-clockwise from outside
  std::vector<std::uint8_t>              sides;         ///< per facet
};

const std::array<VoxelCell, 256> &
VoxelCells();

/** The corners of each side of a voxel as a set. */
inline constexpr std::array<std::uint8_t, 6> voxelSideMasks{ 0x55, 0xAA, 0x33, 0xCC, 0x0F, 0xF0 };

} // namespace voxelcore
