#pragma once
// RunCoreJob in steps, for jobs that hold several of them.

#include "voxelcore/CoreJob.h"
#include "voxelcore/OutputTransaction.h"

namespace voxelcore
{

/** Everything a user could have given wrong that can be seen before reading. \throws UsageError, OutputError */
void
CheckCoreTargets(const CoreOptions & options, OutputTransaction & transaction);

/** RunCoreJob up to the moment at which its files get their names. CheckCoreTargets comes first. */
CoreResult
StageCoreJob(const CoreOptions & options, OutputTransaction & transaction, const JobContext & context);

} // namespace voxelcore
