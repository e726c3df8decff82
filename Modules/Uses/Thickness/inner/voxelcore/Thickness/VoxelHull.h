#pragma once
// The convex hull of voxels.

#include "voxelcore/Shape/VoxelShape.h"

#include <vector>

namespace voxelcore
{

/** The voxels whose centres lie in the convex hull of the centres of the shapes' voxels, all shapes together, exactly;
 *  the hull is the same whatever the spacing. Empty where these centres lie in one plane. */
VoxelShape
HullOfVoxels(const std::vector<VoxelShape> & shapes);

} // namespace voxelcore
