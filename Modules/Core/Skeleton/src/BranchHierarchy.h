#pragma once
// Which branch springs from which, seen from a root.

#include "voxelcore/Skeleton/BranchTable.h"

namespace voxelcore
{

/** Given the numbers of each branch by itself, fills in their places in the hierarchy, and the axes; counts components
 *  and cycles. */
void
BuildHierarchy(const SkeletonGraph & graph, const MeasureOptions & options, BranchTable & table);

} // namespace voxelcore
