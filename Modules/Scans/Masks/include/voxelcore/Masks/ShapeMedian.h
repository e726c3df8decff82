#pragma once
// Salt-and-pepper noise: a median filter.

#include "voxelcore/Base/Progress.h"
#include "voxelcore/Shape/ShapeOperations.h"

#include <cstdint>
#include <string>

namespace voxelcore
{

/** The side of a median filter's cube in voxels: odd, 3 to 15. */
struct MedianWidth
{
  std::int32_t voxels = 3;
};

/** \throws UsageError */
MedianWidth
ParseMedianWidth(const std::string & text);

/** The voxels in whose cube of that side, itself in the middle, more than half are in. What is thinner than half
 *  of the cube goes, and the topology may change in any way; components are not counted. In a tight box; the same for
 *  every number of threads, and turned with the shape.
 *  \throws UsageError for another width; Cancelled when the callback says so. */
EditedShape
MedianShape(const VoxelShape & shape, MedianWidth width, const ProgressCallback & progress = {});

} // namespace voxelcore
