#pragma once
// All labels of a job, one after the other or side by side.

#include "voxelcore/Jobs/CoreJob.h"

#include <functional>
#include <optional>
#include <vector>

namespace voxelcore
{

/** Computes the core of each label and hands it to `take`, in the labels' order, from the calling thread. The labels'
 *  shapes are used up. `scan` is the box that was read, at whose border bodies may be cut; none of a mesh. Adds to
 *  `seconds`, for shape, delaunay, core and prune; the clock stands still while `take` works. With `goOn` a label whose
 *  certificate fails is handed over with its failure and nothing else, and the others go on.
 *  \throws what ProcessLabel and `take` throw; of several labels that fail, the first decides. */
void
ProcessLabels(std::vector<EditedLabel> &                labels,
              const CoreOptions &                       options,
              const ImageGeometry &                     geometry,
              const SurfaceSource &                     surface,
              const std::optional<VoxelBox> &           scan,
              const ProgressCallback &                  progress,
              const std::function<void(LabelOutcome)> & take,
              StageSeconds &                            seconds,
              bool                                      goOn = false);

} // namespace voxelcore
