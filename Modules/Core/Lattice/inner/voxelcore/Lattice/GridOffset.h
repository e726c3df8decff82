#pragma once
// Whether two images have their voxels at the same places.

#include "voxelcore/Lattice/ImageGeometry.h"

#include <array>
#include <cstdint>
#include <optional>

namespace voxelcore
{

/** How many voxels of `grid` the first voxel of `other` lies from its own. None unless all voxels of `other` lie where
 *  `grid` has voxels, or would have some if it went on, to within `close` voxels of `grid`. */
std::optional<std::array<std::int32_t, 3>>
GridOffset(const ImageGeometry & grid, const ImageGeometry & other, double close);

/** Whether both also have the same size and unit: each voxel of one is a voxel of the other. */
bool
HaveSameVoxels(const ImageGeometry & grid, const ImageGeometry & other, double close);

} // namespace voxelcore
