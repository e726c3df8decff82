#pragma once
// RunCoreJob in steps, for jobs that hold several of them.

#include "voxelcore/CoreJob.h"
#include "voxelcore/OutputTransaction.h"

namespace voxelcore
{

/** Everything a user could have given wrong that can be seen before reading. \throws UsageError, OutputError */
void
CheckCoreTargets(const CoreOptions & options, OutputTransaction & transaction);

/** RunCoreJob up to the moment at which its files get their names. CheckCoreTargets comes first. With `labelByLabel`,
 *  into a folder, those of each label get theirs when it is done, and labels that are done are passed over. */
CoreResult
StageCoreJob(const CoreOptions & options,
             OutputTransaction & transaction,
             const JobContext &  context,
             bool                labelByLabel = false);

} // namespace voxelcore
