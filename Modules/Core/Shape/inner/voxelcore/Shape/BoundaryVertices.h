#pragma once
// The lattice points on the boundary of a voxel shape (paper, section 3.2: the set P).

#include "voxelcore/Shape/VoxelShape.h"

namespace voxelcore
{

/** Lattice points whose 8 voxels are neither all in nor all out, in scan order (z, then y, then x fastest),
 *  in lattice coordinates of the scan. Empty for an empty shape. */
std::vector<LatticePoint>
BoundaryVertices(const VoxelShape & shape);

/** Their number, without making the list. */
std::uint64_t
CountBoundaryVertices(const VoxelShape & shape);

} // namespace voxelcore
