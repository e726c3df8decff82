#pragma once
// `voxelcore voxelize`

#include "voxelcore/Options/Command.h"
#include "voxelcore/Meshes/VoxelizeJob.h"

namespace voxelcore
{

extern const Command kVoxelizeCommand;

/** \throws UsageError, naming the option, for a value without sense */
VoxelizeJobOptions
VoxelizeOptionsFrom(const ParameterValues & values);

} // namespace voxelcore
