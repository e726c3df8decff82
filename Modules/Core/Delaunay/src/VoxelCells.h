#pragma once
// The smallest Delaunay cells: boundary vertices among the corners of one inside voxel, when they span space.

#include "CellHull.h"

#include <array>
#include <span>

namespace voxelcore
{

/** For each of the 256 sets of corners (corner c = x + 2 y + 4 z is bit c): its hull when it spans space. */
struct VoxelCell
{
  struct Facet
  {
    std::uint8_t side = 6; ///< of the voxel that it lies on: 0 and 1 for x = 0 and 1, then y, then z; else 6
    std::uint8_t size = 0; ///< a plane holds up to four corners of a voxel
    std::array<std::uint8_t, 4> corners{}; ///< counter-clockwise from outside
  };

  bool                        spansSpace = false;
  std::array<std::uint8_t, 4> tetrahedron{}; ///< four corners not in one plane
  std::uint8_t                facetCount = 0;
  std::array<Facet, 12>       facets; ///< as many as eight points can have

  std::span<const Facet>
  Facets() const
  {
    return { facets.data(), facetCount };
  }
};

const std::array<VoxelCell, 256> &
VoxelCells();

/** The corners of each side of a voxel as a set. */
inline constexpr std::array<std::uint8_t, 6> voxelSideMasks{ 0x55, 0xAA, 0x33, 0xCC, 0x0F, 0xF0 };

} // namespace voxelcore
