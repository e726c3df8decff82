#pragma once
// The numbers of one branch by itself.

#include "voxelcore/Skeleton/BranchTable.h"

namespace voxelcore
{

/** All of a record but its place among other branches. */
BranchRecord
MeasureBranch(const SkeletonGraph & graph, std::size_t branch);

} // namespace voxelcore
