#pragma once
// `voxelcore core`: a scan in, certified medial surfaces out.

#include "voxelcore/Imaging/LabelVolume.h"
#include "voxelcore/Jobs/DisplayTargets.h"
#include "voxelcore/Jobs/JobContext.h"
#include "voxelcore/Jobs/RefineStage.h"
#include "voxelcore/Jobs/SkeletonTargets.h"
#include "voxelcore/Masks/ShapeEdits.h"
#include "voxelcore/Models/MedialModel.h"
#include "voxelcore/Models/SkeletonModel.h"
#include "voxelcore/Report/CoreReport.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace voxelcore
{

struct CoreOptions
{
  std::filesystem::path          scan; ///< or a mesh
  ReadOptions                    reading;
  std::optional<std::int64_t>    resolution; ///< of a mesh; else its voxels have the spacing in `reading`
  ShapeEditOptions               edits;
  std::vector<Lambda>            lambdas;    ///< at least one; ParseLambdas gives them
  std::vector<Tolerance>         tolerances; ///< none: pruned by lambda; else there is one lambda, the floor
  RefineOptions                  refine;     ///< of cores that are written, and of skeletons that ask for it
  std::filesystem::path          output;     ///< a model file, or a folder (IsFolderOutput); empty: no core is written
  std::optional<SkeletonRequest> skeleton;   ///< skeletons too; its lambda is 0 or one of `lambdas`
  SkeletonTargets                skeletonTargets;
  std::filesystem::path          skeletonOutput; ///< .vtp, or a folder
  std::optional<std::filesystem::path> report;
  std::optional<std::filesystem::path> table;   ///< .csv, a row per label
  DisplayTargets                       display; ///< of the first result of each label
  ModelOptions                         model;
  std::map<std::string, std::string>   further; ///< options without a field of their own; recorded
  Engine                               engine = Engine::Auto;
  std::filesystem::path                join; ///< folder of parts (BlockJob.h) to take the cells from; empty: computed
  bool                                 crossCheck = false; ///< both engines must find the same cells
  int                                  threads = 0;        ///< only recorded
  std::optional<std::uint64_t>         memory;             ///< bytes; refused when PredictJob says more
  bool                                 force = false;
  std::string                          command; ///< only recorded
};

struct CoreResult
{
  CoreReport               report;
  std::vector<std::string> warnings; ///< about the scan; a user must see them
  std::vector<std::string> notes;    ///< what edits changed, what a file format could not hold
};

/** Reads, computes label by label (small ones side by side), certifies, writes. Into one file everything is written or
 *  nothing. In a folder each label is written when it is done, and the same job, run again, goes on: labels whose files
 *  are there as they were written, from the same scan, options and sources, are not computed again. A label whose
 *  certificate fails is not written, nor are tables and report then; the others are. What is for looking at
 *  (CoreOptions::display) needs all labels in memory: with it a folder, too, is written as one. The result does not
 *  depend on the number of threads (OpenMP's). \throws UsageError, InputError, OutputError, CertificateError,
 *  Cancelled */
CoreResult
RunCoreJob(const CoreOptions & options, const JobContext & context = {});

/** What was asked for, as reports and files have it. */
ParameterRecord
DescribeParameters(const CoreOptions &    options,
                   const LabelMap &       map,
                   const EditedLabels &   edited,
                   const SpacingWeights & weights);

/** What is asked of each label, but for where its cells come from. */
CertifiedRequest
RequestOf(const CoreOptions & options, SurfaceSource surface);

/** One label's share of a job. */
struct LabelOutcome
{
  LabelRecord                       record;
  std::vector<ModelPart>            parts; ///< one per lambda or tolerance, in LPS mm
  std::optional<SkeletonPart>       skeleton;
  std::optional<CertifiedThickness> thickness;
  StageSeconds                      seconds;
  std::string                       failure; ///< why its certificate failed, where other labels go on
};

/** What a record says of a label before anything is computed. */
LabelRecord
DescribeLabel(const EditedLabel & edited, const ImageGeometry & geometry);

/** Everything between reading and writing for one label: what ComputeCertified() gives, told as a record.
 *  \throws what ComputeCertified() throws; the errors name the label */
LabelOutcome
ProcessLabel(EditedLabel              edited,
             const ImageGeometry &    geometry,
             CertifiedRequest         request,
             const ProgressCallback & progress = {});

} // namespace voxelcore
