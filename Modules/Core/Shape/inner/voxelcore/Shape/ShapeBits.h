#pragma once
// Packed rows cut and moved, a word at a time.

#include "voxelcore/Shape/VoxelShape.h"

namespace voxelcore
{

/** The smallest box that holds all voxels (size 0 and the same lower corner for an empty shape). */
VoxelBox
TightBox(const VoxelShape & shape);

/** The voxels inside `box`, which must lie within the shape's box, as a shape of just that box. */
VoxelShape
CopyBox(const VoxelShape & shape, const VoxelBox & box);

/** Sets the voxels of `shape` in `result`, whose box holds its box. */
void
PutInto(const VoxelShape & shape, VoxelShape & result);

/** CropToVoxels without a copy where the box is tight already. */
VoxelShape
Tightened(VoxelShape shape);

} // namespace voxelcore
