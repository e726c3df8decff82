#pragma once
// The balls of a whole voxel core that bound local thickness from above: see voxelcore/InscribedBalls.h, 2 to 6.

#include "CoreBalls.h"

#include "voxelcore/InscribedBalls.h"
#include "voxelcore/VoxelShape.h"

namespace voxelcore
{

/** Edges are cut into pieces along which neither radius nor bound grows by more than `step` of a voxel's shortest side,
 *  greater than 0. In mm. */
PaintingBalls
BoundingBalls(const VoxelShape & shape, const CoreBalls & core, double step);

} // namespace voxelcore
