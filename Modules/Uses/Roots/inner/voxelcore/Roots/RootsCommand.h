#pragma once
// `voxelcore roots`

#include "voxelcore/Options/Command.h"
#include "voxelcore/Roots/RootsJob.h"

namespace voxelcore
{

extern const Command kRootsCommand;

/** \throws UsageError, naming the option, for a value without sense */
RootsOptions
RootsOptionsFrom(const ParameterValues & values);

} // namespace voxelcore
