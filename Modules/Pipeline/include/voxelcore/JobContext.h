#pragma once
// What every job gets from the program that runs it.

#include "voxelcore/OutputTransaction.h"
#include "voxelcore/Progress.h"

namespace voxelcore
{

struct JobContext
{
  ProgressCallback    progress;              ///< fraction of the whole job; the stage names the label, too
  TemporaryRegistry * temporaries = nullptr; ///< for a signal handler that must not leave files; may be null
};

} // namespace voxelcore
