#pragma once
// What every job gets from the program that runs it.

#include "voxelcore/OutputTransaction.h"
#include "voxelcore/Progress.h"

namespace voxelcore
{

struct JobContext
{
  /** Gets the fraction of the whole job; the stage names the label, or which labels run side by side. Such calls come
   *  from several threads, though never two at a time. */
  ProgressCallback    progress;
  TemporaryRegistry * temporaries = nullptr; ///< for a signal handler that must not leave files; may be null
};

} // namespace voxelcore
