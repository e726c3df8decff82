#pragma once
// Balls as voxels.

#include "voxelcore/Base/Progress.h"
#include "voxelcore/Shape/VoxelShape.h"

#include <array>
#include <span>

namespace voxelcore
{

/** The voxels of a box whose centres lie inside at least one of the balls: nearer to its centre than its radius.
 *  Centres in lattice coordinates (voxel index + 1/2), spacing and radii in mm. The same for every number of threads.
 *  \throws Cancelled when the callback says so. */
VoxelShape
UnionOfBalls(const VoxelBox &                       box,
             const std::array<double, 3> &          spacing,
             std::span<const std::array<double, 3>> centres,
             std::span<const double>                radius,
             const ProgressCallback &               progress = {});

} // namespace voxelcore
