#pragma once
// Whether a complex lies in its shape: what a certificate says, found with nothing of what places vertices.

#include "voxelcore/Shape/VoxelShape.h"

#include <array>
#include <span>

namespace voxelcore
{

/** Whether all places, in lattice coordinates, lie in the open shape: every voxel that holds one, its faces, edges and
 *  corners included, is in. A place that is no number lies nowhere. */
bool
LieInside(const VoxelShape & shape, std::span<const std::array<double, 3>> places);

} // namespace voxelcore
