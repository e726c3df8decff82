#pragma once
// `voxelcore phantom`

#include "voxelcore/Options/Command.h"
#include "voxelcore/Phantom/PhantomJob.h"

namespace voxelcore
{

extern const Command kPhantomCommand;

/** \throws UsageError, naming the option, for a value without sense */
PhantomJobOptions
PhantomOptionsFrom(const ParameterValues & values);

} // namespace voxelcore
