#pragma once
// Whether arrays are a skeleton.

#include "voxelcore/Skeleton/SkeletonGraph.h"

namespace voxelcore
{

/** Whether arrays that come from outside are those of a skeleton: counts agree, every index is of a point or node that
 *  is there, branches begin and end at their nodes, places are finite, radii are finite and not below 0. */
bool
IsSkeleton(const SkeletonGraph & graph);

} // namespace voxelcore
