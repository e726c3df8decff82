#pragma once
// What the commands of the program's own jobs ask for, from the values of their options.

#include "voxelcore/Imaging/LabelVolume.h"
#include "voxelcore/Jobs/BlockJob.h"
#include "voxelcore/Jobs/CoreJob.h"
#include "voxelcore/Jobs/InfoJob.h"
#include "voxelcore/Jobs/PruneJob.h"
#include "voxelcore/Jobs/ReconstructJob.h"
#include "voxelcore/Jobs/RenderJob.h"
#include "voxelcore/Jobs/SkeletonJob.h"
#include "voxelcore/Jobs/VerifyJob.h"
#include "voxelcore/Masks/ShapeEdits.h"
#include "voxelcore/Options/Command.h"

#include <optional>

namespace voxelcore
{

extern const Command kCoreCommand;
extern const Command kSkeletonCommand;
extern const Command kInfoCommand;
extern const Command kVerifyCommand;
extern const Command kRenderCommand;
extern const Command kMeasureCommand;
extern const Command kPruneCommand;
extern const Command kReconstructCommand;

// Each throws UsageError, naming the option, for a value without sense.

CoreOptions
CoreOptionsFrom(const ParameterValues & values);
/** What is asked of shapes and cores, wherever they come from: no path is read, and none need be there. */
CoreOptions
CoreOptionsWithoutFiles(const ParameterValues & values);
/** None unless --blocks is given. */
std::optional<BlockOptions>
BlockOptionsFrom(const ParameterValues & values);
InfoOptions
InfoOptionsFrom(const ParameterValues & values);
VerifyOptions
VerifyOptionsFrom(const ParameterValues & values);
PruneOptions
PruneOptionsFrom(const ParameterValues & values);
PruneOptions
PruneOptionsWithoutFiles(const ParameterValues & values);
ReconstructOptions
ReconstructOptionsFrom(const ParameterValues & values);
/** `--resolution`: of meshes; none unless it is given. */
std::vector<std::int64_t>
ResolutionsFrom(const ParameterValues & values);
DisplayTargets
DisplayTargetsFrom(const ParameterValues & values);
std::optional<SkeletonRequest>
CoreSkeletonFrom(const ParameterValues & values);
SkeletonTargets
TargetsFrom(const ParameterValues & values, const Command & command);
SkeletonOptions
SkeletonOptionsFrom(const ParameterValues & values);
/** How a finished core is burned; its lambda is 0. */
SkeletonRequest
SkeletonRequestFrom(const ParameterValues & values);
/** What `measure` does to a finished skeleton. */
BranchRequest
MeasureBranchesFrom(const ParameterValues & values);
MeasureJobOptions
MeasureOptionsFrom(const ParameterValues & values);
RenderJobOptions
RenderOptionsFrom(const ParameterValues & values);

} // namespace voxelcore
