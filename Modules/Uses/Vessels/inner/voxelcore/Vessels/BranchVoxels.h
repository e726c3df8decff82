#pragma once
// Skeletons as voxels of their scan: which branch each voxel of a body belongs to, and the lines themselves.

#include "voxelcore/Lattice/ImageGeometry.h"
#include "voxelcore/Shape/VoxelField.h"
#include "voxelcore/Shape/VoxelShape.h"
#include "voxelcore/Skeleton/SkeletonGraph.h"

#include <cstdint>

namespace voxelcore
{

/** At each voxel of a body 1 + the number of the branch it belongs to: that one with a ball whose surface is nearest to
 *  the voxel's middle, which is the deeper in a ball the less; of equals the first. Balls are those of SkeletonGraph,
 *  and between its points, less than a voxel apart, such as change evenly. 0 everywhere where there are no branches.
 *  Four bytes a voxel. The same for every number of threads. `graph` in LPS mm of the geometry. */
VoxelField<std::uint32_t>
BranchOfVoxels(const SkeletonGraph & graph, const VoxelShape & shape, const ImageGeometry & geometry);

/** Adds the voxels of a body that its skeleton runs through, in the box of `voxels`: of each branch a line, in which a
 *  voxel shares a corner at least with the next one and none could be left out; isolated points; and of faces that
 *  stay all voxels that they meet. */
void
AddSkeletonVoxels(const SkeletonGraph & graph,
                  const VoxelShape &    shape,
                  const ImageGeometry & geometry,
                  VoxelShape &          voxels);

} // namespace voxelcore
