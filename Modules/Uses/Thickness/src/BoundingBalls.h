#pragma once
// The balls of a whole voxel core that bound local thickness from above: see voxelcore/Thickness/InscribedBalls.h, 2 to
// 6.

#include "CoreBalls.h"

#include "voxelcore/Shape/VoxelShape.h"
#include "voxelcore/Thickness/InscribedBalls.h"

namespace voxelcore
{

/** Edges are cut into pieces along which neither radius nor bound grows by more than `step` of a voxel's shortest side,
 *  greater than 0. In mm. */
PaintingBalls
BoundingBalls(const VoxelShape & shape, const CoreBalls & core, double step);

} // namespace voxelcore
