#pragma once
// A scan's labels as the jobs that compute maps of them read them.

#include "voxelcore/Base/StagePlan.h"
#include "voxelcore/Jobs/CoreJob.h"

#include <string>
#include <vector>

namespace voxelcore
{

struct ScanLabels
{
  ImageGeometry            geometry;
  EditedLabels             edited;
  SurfaceSource            surface;  ///< of refinement; none without it
  std::vector<std::string> warnings; ///< about the scan
};

/** Reads and edits the labels that `options` choose. Fills in the report's command, input with its digest,
 *  parameters and reading time. Takes two steps of the plan. \throws InputError, UsageError, Cancelled */
ScanLabels
ReadScanLabels(const CoreOptions & options, StagePlan & plan, CoreReport & report);

/** Progress of one of several labels, between two shares of the whole: "name (2/5)". */
ProgressCallback
ProgressOfLabel(const ProgressCallback & whole,
                const std::string &      name,
                std::size_t              index,
                std::size_t              count,
                double                   begin,
                double                   end);

/** Adds what one label took. */
void
AddComputing(StageSeconds & all, const StageSeconds & one);

} // namespace voxelcore
