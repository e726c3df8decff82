#pragma once
// `voxelcore skeleton --probability`

#include "voxelcore/Compare/ProbabilityJob.h"
#include "voxelcore/Options/Command.h"

namespace voxelcore
{

extern const Extension kProbabilityExtension;

/** Of a command that asks for it. \throws UsageError, naming the option, for a value without sense */
ProbabilityOptions
ProbabilityOptionsFrom(const ParameterValues & values);

} // namespace voxelcore
