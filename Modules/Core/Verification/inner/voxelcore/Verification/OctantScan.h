#pragma once
// One pass over the lattice corners of a voxel shape, looking at the 8 voxels around each.

#include "voxelcore/Shape/VoxelShape.h"

namespace voxelcore
{

/** What the pass finds. */
struct OctantScan
{
  std::vector<LatticePoint> boundary;  ///< corners with some but not all of their 8 voxels in; lattice coordinates
  std::int64_t              euler = 0; ///< Euler number of the open shape
};

/** Euler number as a sum over corners: each takes 1/8 of its voxels, 1/4 of its inner faces, 1/2 of its inner edges,
 *  and itself. Corners with none or all voxels in add nothing. */
OctantScan
ScanOctants(const VoxelShape & shape);

} // namespace voxelcore
