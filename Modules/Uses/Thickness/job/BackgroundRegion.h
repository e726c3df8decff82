#pragma once
// The background that `voxelcore thickness` measures, too.

#include "voxelcore/Thickness/ThicknessJob.h"

#include <vector>

namespace voxelcore
{

/** The voxels among which the background of some shapes is measured: the box around them, their hull, or the labels or
 *  mask of `within`. \throws InputError where a label asked for is not there, a mask has other voxels than the scan, or
 *  the hull is flat */
VoxelShape
RegionOfBackground(const ThicknessOptions &        options,
                   const ImageGeometry &           geometry,
                   const std::vector<VoxelShape> & shapes,
                   const ProgressCallback &        progress);

/** The region's voxels that none of the shapes has. */
VoxelShape
BackgroundIn(VoxelShape region, const std::vector<VoxelShape> & shapes);

/** Per ball, whether it reaches the centre of a voxel outside the region and the shapes when it is grown by one voxel:
 *  it ends at the region, then, and not at a shape. */
std::vector<char>
BallsAtRegion(const PaintingBalls &           balls,
              const ImageGeometry &           geometry,
              const VoxelShape &              region,
              const std::vector<VoxelShape> & shapes);

} // namespace voxelcore
