#pragma once
// What a shape's boundary is made of: cheap to count, and enough to foretell the size of its core.

#include "voxelcore/Shape/VoxelShape.h"

#include <cstdint>

namespace voxelcore
{

struct BoundaryCounts
{
  std::uint64_t voxels = 0;
  std::uint64_t borderVoxels = 0; ///< voxels with a boundary vertex: not all of their 26 neighbours are in
  std::uint64_t vertices = 0;     ///< boundary vertices
  // Parts of the border voxels, by which of their corners are boundary vertices.
  std::uint64_t cellVoxels = 0; ///< those that span space: each is a Delaunay cell
  std::uint64_t fullVoxels = 0; ///< of these, those of which all eight corners are
  std::uint64_t flatVoxels = 0; ///< four in one plane
  std::uint64_t evenVoxels = 0; ///< those of one side, and of the eight voxels around in its plane as well
  // How much of the boundary is of thick parts: cubes of voxels that fit in, one for each place.
  std::uint64_t cubes15 = 0; ///< of 15 voxels a side: a ball of more than seven voxels' radius has room
  std::uint64_t cubes17 = 0; ///< of 17
};

/** In one pass over the packed bits. */
BoundaryCounts
CountBoundary(const VoxelShape & shape);

/** Faces between a voxel that is in and one that is not. */
std::uint64_t
CountBoundarySquares(const VoxelShape & shape);

} // namespace voxelcore
