#pragma once
// `voxelcore skeleton` and `voxelcore measure`: curve skeletons of a scan or of a finished core, and their numbers.

#include "voxelcore/Delaunay/DelaunayCells.h"
#include "voxelcore/Imaging/LabelVolume.h"
#include "voxelcore/Jobs/DisplayTargets.h"
#include "voxelcore/Jobs/JobContext.h"
#include "voxelcore/Jobs/RefineStage.h"
#include "voxelcore/Jobs/SkeletonTargets.h"
#include "voxelcore/Masks/ShapeEdits.h"
#include "voxelcore/Models/SkeletonModel.h"
#include "voxelcore/Report/CoreReport.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace voxelcore
{

struct SkeletonOptions
{
  std::filesystem::path
              input; ///< a scan or mesh, or a .vtp that 'voxelcore core' wrote; with a resolution .vtp is a mesh
  ReadOptions reading;
  std::optional<std::int64_t>          resolution; ///< of a mesh
  ShapeEditOptions                     edits;
  std::map<std::string, std::string>   further; ///< options without a field of their own; recorded
  SkeletonRequest                      stage;   ///< says too whether it is refined
  RefineOptions                        refine;  ///< to which surface
  SkeletonTargets                      targets;
  std::filesystem::path                output; ///< .vtp, or a folder (IsFolderOutput)
  std::optional<std::filesystem::path> report;
  DisplayTargets                       display;
  Engine                               engine = Engine::Auto;
  int                                  threads = 0; ///< only recorded
  bool                                 force = false;
  std::string                          command; ///< only recorded
};

struct MeasureJobOptions
{
  std::filesystem::path skeleton; ///< .vtp that 'voxelcore skeleton' wrote
  BranchRequest         branches;
  SkeletonTargets       targets;
  std::filesystem::path output; ///< .csv, or .vtp
  bool                  force = false;
};

struct SkeletonResult
{
  CoreReport               report; ///< each label has its skeleton
  std::vector<std::string> warnings;
  std::vector<std::string> notes;
};

/** Computes, certifies and writes the skeletons of all labels (of a scan small ones side by side). Either everything is
 *  written or nothing. The result does not depend on the number of threads.
 *  \throws UsageError, InputError, OutputError, CertificateError, Cancelled */
SkeletonResult
RunSkeletonJob(const SkeletonOptions & options, const JobContext & context = {});

/** Finished skeletons cut as `now` says, and measured anew. `report` is that on them, with a label for each, and is
 *  told; `name` is what messages call them. \throws UsageError, InputError */
void
MeasureAgain(std::vector<SkeletonPart> &   parts,
             const BranchRequest &         now,
             CoreReport &                  report,
             const std::filesystem::path & name);

/** Measures a finished skeleton, writes its tables. \throws UsageError, InputError, OutputError, Cancelled */
SkeletonResult
RunMeasureJob(const MeasureJobOptions & options, const JobContext & context = {});

} // namespace voxelcore
