#pragma once
// `voxelcore core`: a scan in, certified medial surfaces out.

#include "voxelcore/BumpPruning.h"
#include "voxelcore/CoreReport.h"
#include "voxelcore/DelaunayCells.h"
#include "voxelcore/DisplayTargets.h"
#include "voxelcore/JobContext.h"
#include "voxelcore/LabelVolume.h"
#include "voxelcore/LambdaPruning.h"
#include "voxelcore/MedialModel.h"
#include "voxelcore/ShapeEdits.h"
#include "voxelcore/SkeletonModel.h"
#include "voxelcore/SkeletonStage.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace voxelcore
{

struct CoreOptions
{
  std::filesystem::path        scan; ///< or a mesh
  ReadOptions                  reading;
  std::optional<std::int64_t>  resolution; ///< of a mesh; else its voxels have the spacing in `reading`
  ShapeEditOptions             edits;
  std::vector<Lambda>          lambdas;  ///< at least one; ParseLambdas gives them
  std::vector<BumpHeight>      bumps;    ///< none: pruned by lambda; else there is one lambda, the floor
  RefineOptions                refine;   ///< by lambda only, without skeletons
  std::filesystem::path        output;   ///< a model file, or a folder (IsFolderOutput); empty: no core is written
  std::optional<SkeletonStage> skeleton; ///< skeletons too; its lambda is 0 or one of `lambdas`
  std::filesystem::path        skeletonOutput; ///< .vtp, or a folder
  std::optional<std::filesystem::path> report;
  std::optional<std::filesystem::path> table;   ///< .csv, a row per label
  DisplayTargets                       display; ///< of the first result of each label
  ModelOptions                         model;
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
 *  (CoreOptions::display) needs all labels in memory: with it a folder, too, is written as one. The result does not depend on the number of threads (OpenMP's).
 *  \throws UsageError, InputError, OutputError, CertificateError, Cancelled */
CoreResult
RunCoreJob(const CoreOptions & options, const JobContext & context = {});

/** Gives the cells of a shape, with these boundary vertices, where they come from elsewhere. */
using CellSource =
  std::function<DelaunayCells(const std::vector<LatticePoint> & points, const ProgressCallback & progress)>;

/** One label's share of a job. */
struct LabelOutcome
{
  LabelRecord                 record;
  std::vector<ModelPart>      parts; ///< one per lambda or bump height, in LPS mm
  std::optional<SkeletonPart> skeleton;
  StageSeconds                seconds;
  std::string                 failure; ///< why its certificate failed, where other labels go on
};

/** Everything between reading and writing for one label; depends on nothing but its arguments. Cells come from `source`
 *  where there is one; with `surface` cores are refined, which goes with lambdas alone. With `crossCheck` both engines run, one after the other; TetGen can do so once at a time in a process. The skeleton's lambda is 0 or one of
 *  `lambdas`; with bump heights it is 0.
 *  \throws CertificateError when a complex does not have the shape's topology or leaves the shape, a boundary vertex lies
 *  farther from it than the bump height, or the engines differ. */
LabelOutcome
ProcessLabel(LabelShape                      label,
             const ImageGeometry &           geometry,
             const SpacingWeights &          weights,
             const std::vector<Lambda> &     lambdas,
             Engine                          engine,
             const ProgressCallback &        progress = {},
             bool                            crossCheck = false,
             const SkeletonStage *           skeleton = nullptr,
             const std::vector<BumpHeight> & bumps = {},
             const CellSource &              source = {},
             const SurfaceSource &           surface = {});

/** Whether every vertex lies strictly inside the open shape; positions in lattice coordinates. */
bool
IsEnclosed(const MedialComplex & core, const VoxelShape & shape);

} // namespace voxelcore
