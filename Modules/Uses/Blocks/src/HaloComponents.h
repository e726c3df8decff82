#pragma once
// The components of a shape that a block has to do with.

#include "voxelcore/Shape/VoxelShape.h"

namespace voxelcore
{

/** The 6-connected components with a voxel in the range, in their tight bounding box. */
VoxelShape
ComponentsThatMeet(const VoxelShape & shape, const VoxelBox & range);

/** Puts the voxels of `part` into `shape`, whose box holds its box. */
void
Include(const VoxelShape & part, VoxelShape & shape);

} // namespace voxelcore
