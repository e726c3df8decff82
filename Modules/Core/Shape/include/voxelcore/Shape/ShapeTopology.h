#pragma once
// Topology numbers of the open voxel shape, and of the closed one, from its voxels alone.

#include "voxelcore/Lattice/TopologyNumbers.h"
#include "voxelcore/Shape/VoxelShape.h"

namespace voxelcore
{

/** Euler number = voxels - inner faces + inner edges - inner corners, where an inner element has all its 2, 4 or 8
 *  voxels in; b0 = 6-connected components; b2 = 26-connected components of the background - 1 (the outside is one);
 *  b1 = b0 + b2 - euler. */
TopologyNumbers
ComputeShapeTopology(const VoxelShape & shape);

/** The same of the closed union of the voxels: b0 = 26-connected components; b2 = 6-connected components of the
 *  background - 1; Euler number = corners - edges + faces - voxels, each that touches a voxel; b1 = b0 + b2 - euler. */
TopologyNumbers
ComputeClosedTopology(const VoxelShape & shape);

/** Number of 26-connected components of the voxels: what a reader used to 26-connectivity would count. */
std::int64_t
CountComponents26(const VoxelShape & shape);

} // namespace voxelcore
