#pragma once
// `voxelcore follow`

#include "voxelcore/Follow/FollowJob.h"
#include "voxelcore/Options/Command.h"

namespace voxelcore
{

extern const Command kFollowCommand;

/** \throws UsageError, naming the option, for a value without sense */
FollowOptions
FollowOptionsFrom(const ParameterValues & values);

} // namespace voxelcore
