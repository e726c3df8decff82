#pragma once
// `voxelcore straighten`

#include "voxelcore/Options/Command.h"
#include "voxelcore/Vessels/StraightenJob.h"

namespace voxelcore
{

extern const Command kStraightenCommand;

/** \throws UsageError, naming the option, for a value without sense */
StraightenOptions
StraightenOptionsFrom(const ParameterValues & values);

} // namespace voxelcore
