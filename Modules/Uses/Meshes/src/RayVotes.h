#pragma once
// What is inside a surface with holes: six rays from each centre, along the axes in both directions, have a vote each.

#include "ExactTriangle.h"
#include "MeshSurface.h"
#include "voxelcore/Shape/VoxelShape.h"

namespace voxelcore
{

/** Puts the voxels in for which at least four rays vote. Returns how many voxels, in or not, are not agreed on.
 *  \throws InputError when there is no voxel that five rays want in; Cancelled */
std::uint64_t
FillByVotes(const IndexMesh &        mesh,
            const MeshSurface &      surface,
            const VoxelGrid &        grid,
            VoxelShape &             shape,
            const ProgressCallback & progress);

} // namespace voxelcore
