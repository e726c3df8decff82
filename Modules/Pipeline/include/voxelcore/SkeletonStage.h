#pragma once
// What a user can choose about curve skeletons and their branches.

#include "voxelcore/BranchTable.h"
#include "voxelcore/BumpPruning.h"
#include "voxelcore/LambdaPruning.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace voxelcore
{

/** What to do with the branches of a skeleton, and what to write. Lengths with their unit, as lambda. */
struct BranchOptions
{
  std::optional<Lambda>                pruneLength;    ///< tips' branches shorter than this go
  double                               pruneRadii = 0; ///< and those shorter than so many radii at their other end
  bool                                 cutLoops = false;
  bool                                 splitAtJunctions = false;
  RootChoice                           root;
  std::optional<std::filesystem::path> table; ///< .csv, a row per branch
  std::vector<std::string>             also;  ///< further files beside the result: csv, swc, mrk.json, graphml, ma
};

/** From a core to a curve skeleton. */
struct SkeletonStage
{
  Lambda                    lambda;   ///< the core is pruned to it first
  std::optional<BumpHeight> bumps;    ///< then by bump height, more than 0
  Lambda                    standOut; ///< CurveOptions::branchThreshold
  std::optional<Lambda>     plates;   ///< CurveOptions::plateThreshold
  Lambda                    smooth;   ///< window of FitBranches
  BranchOptions             branches;
};

/** "top", "thickest" or "x,y,z" in LPS mm. \throws UsageError */
RootChoice
ParseRoot(const std::string & text);

/** The inverse of ParseRoot. */
std::string
RootText(const RootChoice & root);

/** Fills pruneLength or pruneRadii from "5mm", "8vox", "2%" or "1.5r". \throws UsageError */
void
ParseBranchLimit(const std::string & text, BranchOptions & options);

/** Comma-separated endings. \throws UsageError for one that is not known */
std::vector<std::string>
ParseAlso(const std::string & text);

} // namespace voxelcore
