#pragma once
// The one channel for progress and cancellation.

#include "voxelcore/Base/Error.h"

#include <functional>
#include <string_view>

namespace voxelcore
{

/** Called with the name of the running stage and the fraction of it that is done (0 to 1).
 *  Returning false asks the callee to stop: it throws Cancelled at its next safe point.
 *  An empty function means nobody is watching. Called from one thread at a time. */
using ProgressCallback = std::function<bool(std::string_view stage, double fraction)>;

/** Reports progress; throws Cancelled when the callback says stop. */
inline void
ReportProgress(const ProgressCallback & progress, std::string_view stage, double fraction)
{
  if (progress && !progress(stage, fraction))
  {
    throw Cancelled();
  }
}

} // namespace voxelcore
