#pragma once
// How a core is burned to curves, from the values given.

#include "ParameterReader.h"
#include "voxelcore/Options/Parameters.h"

#include <filesystem>

namespace voxelcore
{

/** --stand-out, --smooth and --prune-branches; lambda is 0. \throws UsageError, naming the option */
SkeletonRequest
BurningFrom(const ParameterValues & values, CommandId command);

/** --border */
BorderEnds
BorderFrom(const ParameterReader & reader);

/** A finished core was read, edited and pruned already. \throws UsageError, naming an option given that is of scans */
void
RefuseScanOptions(const ParameterValues & values, const std::filesystem::path & input, CommandId command);

} // namespace voxelcore
