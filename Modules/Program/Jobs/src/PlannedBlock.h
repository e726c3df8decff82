#pragma once
// A block read from the part of the scan that it needs, once the first block has planned where that is.

#include "voxelcore/Blocks/BlockRegions.h"
#include "voxelcore/Jobs/BlockJob.h"
#include "voxelcore/Labels/LabelMap.h"

#include <optional>

namespace voxelcore
{

/** Whether blocks of this job can be read alone: edits work on whole labels, and meshes are voxelized whole. */
bool
CanReadBlockAlone(const BlockOptions & options);

/** "<folder>/<scan>_blocks-<n>.vcp" */
std::filesystem::path
PlanPath(const BlockOptions & options);

/** The scan's files and sizes, and what of the options decides how it is read. */
std::string
PlanSource(const BlockOptions & options);

/** What of a scan one block needs. */
struct PlannedBlock
{
  ScanPlan                 plan;
  SpacingWeights           weights;
  std::vector<VoxelShape>  shapes; ///< of each label, at least its voxels in the region of the block
  std::vector<std::string> warnings;
};

/** Reads the region of the block from the scan. Nothing where there is no plan, or it was made for another scan or
 *  other options: then the scan has to be read whole. \throws Cancelled */
std::optional<PlannedBlock>
ReadPlannedBlock(const BlockOptions & options, const ProgressCallback & progress);

/** Keeps the plan for the blocks to come, in place of an older one. \throws OutputError */
void
KeepPlan(const ScanPlan & plan, const BlockOptions & options, const JobContext & context);

} // namespace voxelcore
