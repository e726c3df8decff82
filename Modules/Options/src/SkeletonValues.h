#pragma once
// How a core is burned to curves, from the values given.

#include "voxelcore/Parameters.h"

namespace voxelcore
{

/** --stand-out, --smooth and --prune-branches; lambda is 0. \throws UsageError, naming the option */
SkeletonRequest
BurningFrom(const ParameterValues & values, CommandId command);

} // namespace voxelcore
