#pragma once
// RunCoreJob in steps, for jobs that hold several of them.

#include "voxelcore/Jobs/CoreJob.h"
#include "voxelcore/Jobs/OutputTransaction.h"
#include "voxelcore/Jobs/ReadInput.h"
#include "voxelcore/Jobs/SkeletonJob.h"

#include <functional>
#include <vector>

namespace voxelcore
{

/** Everything a user could have given wrong that can be seen before reading. \throws UsageError, OutputError */
void
CheckCoreTargets(const CoreOptions & options, OutputTransaction & transaction);

/** A job of skeletons alone as one whose core is a step on the way that is not written. */
CoreOptions
CoreOptionsOf(const SkeletonOptions & options);

/** Of a job that writes one skeleton and files beside it: a folder is made, and the skeleton gets the name that the
 *  folder's tables have. */
void
NameInFolder(SkeletonOptions & options, OutputTransaction & transaction);

/** A scan that was read, and its labels as `options.edits` says, or as they were edited further. */
struct ScanAtHand
{
  InputScan    volume;
  EditedLabels edited;

  /** Called with each label that is done, before anything of it is written. May be empty. */
  std::function<void(LabelOutcome & outcome)> done{};
};

/** Called once with the labels that are worked on, before their shapes are used up. */
using ShapesSeen = std::function<void(const std::vector<EditedLabel> & labels, const ImageGeometry & geometry)>;

/** RunCoreJob up to the moment at which its files get their names. CheckCoreTargets comes first. With `labelByLabel`,
 *  into a folder, those of each label get theirs when it is done, and labels that are done are passed over.
 *  With `scan` nothing is read; it is used up. */
CoreResult
StageCoreJob(const CoreOptions & options,
             OutputTransaction & transaction,
             const JobContext &  context,
             bool                labelByLabel = false,
             const ShapesSeen &  seen = {},
             ScanAtHand *        scan = nullptr);

/** The certified skeletons of masks, as `voxelcore skeleton` makes them; an empty one of an empty mask. `name` is that
 *  of their scan. Two run side by side, one thread each: threads of one of them would wait for each other. */
std::vector<SkeletonPart>
SkeletonsOfMasks(std::vector<LabelShape>  masks,
                 const ImageGeometry &    geometry,
                 const SkeletonOptions &  making,
                 const std::string &      name,
                 const ProgressCallback & progress);

} // namespace voxelcore
