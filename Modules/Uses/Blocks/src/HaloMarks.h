#pragma once
// What the balls of a block's voxels can reach, cut out of a shape.

#include "HaloReaches.h"

namespace voxelcore
{

/** The shape in the block and in the halos of its reaches, which have been measured. */
VoxelShape
RestrictToHalos(const VoxelShape & shape, const SpacingWeights & weights, const HaloReaches & reaches);

} // namespace voxelcore
