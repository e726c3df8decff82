#pragma once
// What a shape's boundary is made of: cheap to count, and enough to foretell the size of its core.

#include "voxelcore/VoxelShape.h"

#include <cstdint>

namespace voxelcore
{

struct BoundaryCounts
{
  std::uint64_t voxels = 0;
  std::uint64_t borderVoxels = 0; ///< voxels with a boundary vertex: not all of their 26 neighbours are in
  std::uint64_t vertices = 0;     ///< boundary vertices
  std::uint64_t flatVertices = 0; ///< of these, those amid a flat boundary: the four voxels of one side are in
};

/** In one pass over the packed bits. */
BoundaryCounts
CountBoundary(const VoxelShape & shape);

} // namespace voxelcore
