#pragma once
// `voxelcore skeleton` and `voxelcore measure`: curve skeletons of a scan or of a finished core, and their numbers.

#include "voxelcore/DelaunayCells.h"
#include "voxelcore/JobContext.h"
#include "voxelcore/LabelVolume.h"
#include "voxelcore/LambdaPruning.h"
#include "voxelcore/ShapeEdits.h"
#include "voxelcore/SkeletonModel.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace voxelcore
{

/** What to do with the branches of a skeleton, and what to write. Lengths with their unit, as lambda. */
struct BranchOptions
{
  std::optional<Lambda>    pruneLength;    ///< tips' branches shorter than this go
  double                   pruneRadii = 0; ///< and those shorter than so many radii at their other end
  bool                     cutLoops = false;
  bool                     splitAtJunctions = false;
  RootChoice               root;
  std::vector<std::string> also; ///< further files beside the result: csv, swc, mrk.json, graphml, ma
};

/** "top", "thickest" or "x,y,z" in LPS mm. \throws UsageError */
RootChoice
ParseRoot(const std::string & text);

/** Fills pruneLength or pruneRadii from "5mm", "8vox", "2%" or "1.5r". \throws UsageError */
void
ParseBranchLimit(const std::string & text, BranchOptions & options);

/** Comma-separated endings. \throws UsageError for one that is not known */
std::vector<std::string>
ParseAlso(const std::string & text);

struct SkeletonOptions
{
  std::filesystem::path input; ///< a scan, or a .vtp that 'voxelcore core' wrote
  ReadOptions           reading;
  ShapeEditOptions      edits;
  Lambda                lambda;    ///< the core is pruned to it first
  Lambda                threshold; ///< CurveOptions::branchThreshold
  std::optional<Lambda> plates;    ///< CurveOptions::plateThreshold
  Lambda                smooth;    ///< window of FitBranches
  BranchOptions         branches;
  std::filesystem::path output; ///< .vtp
  Engine                engine = Engine::Auto;
  bool                  force = false;
};

struct MeasureJobOptions
{
  std::filesystem::path skeleton; ///< .vtp that 'voxelcore skeleton' wrote
  BranchOptions         branches;
  std::filesystem::path output; ///< .csv, or .vtp
  bool                  force = false;
};

struct SkeletonResult
{
  std::string              table; ///< for people
  std::vector<std::string> warnings;
  std::vector<std::string> notes;
};

/** Computes, certifies and writes the skeletons of all labels. Either everything is written or nothing.
 *  \throws UsageError, InputError, OutputError, CertificateError, Cancelled */
SkeletonResult
RunSkeletonJob(const SkeletonOptions & options, const JobContext & context = {});

/** Measures a finished skeleton, writes its tables. \throws UsageError, InputError, OutputError, Cancelled */
SkeletonResult
RunMeasureJob(const MeasureJobOptions & options, const JobContext & context = {});

} // namespace voxelcore
