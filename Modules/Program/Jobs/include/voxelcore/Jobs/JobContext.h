#pragma once
// What every job gets from the program that runs it.

#include "voxelcore/Base/StagePlan.h"
#include "voxelcore/Jobs/OutputTransaction.h"
#include "voxelcore/Models/TableHead.h"

#include <functional>

namespace voxelcore
{

struct JobContext
{
  /** Gets the fraction of the whole job; the stage names the label, or which labels run side by side. Such calls come
   *  from several threads, though never two at a time. */
  ProgressCallback progress;
  /** Called once when a job has read its scan, with the memory it will need at its peak, MB; may wait until there is so
   *  much, or throw. May be empty. */
  std::function<void(double)> admit;
  /** Called once with the files that are there when all is done. May be empty. */
  std::function<void(const std::vector<std::filesystem::path> &)> wrote;
  TemporaryRegistry * temporaries = nullptr; ///< for a signal handler that must not leave files; may be null
  bool                unitsInTables = false; ///< columns of tables are called "length [mm]"

  HeadUnits
  Heads(SpatialUnit unit) const
  {
    return unitsInTables ? HeadUnits(unit) : HeadUnits();
  }
};

/** The same, but the progress never goes back: what every job begins with. */
inline JobContext
ForwardOnly(const JobContext & context)
{
  JobContext forward = context;
  forward.progress = ForwardOnly(context.progress);
  return forward;
}

} // namespace voxelcore
