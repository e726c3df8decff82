#pragma once
// `voxelcore compare`

#include "voxelcore/Options/Command.h"
#include "voxelcore/Compare/CompareJob.h"

namespace voxelcore
{

extern const Command kCompareCommand;

/** No path is read, and none need be there. */
CompareOptions
CompareOptionsWithoutFiles(const ParameterValues & values);
/** \throws UsageError, naming the option, for a value without sense */
CompareOptions
CompareOptionsFrom(const ParameterValues & values);

} // namespace voxelcore
