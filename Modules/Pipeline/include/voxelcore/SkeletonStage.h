#pragma once
// What a user can choose about curve skeletons and their branches.

#include "voxelcore/CertifiedSkeleton.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace voxelcore
{

/** What to write of skeletons besides the result. */
struct SkeletonTargets
{
  std::optional<std::filesystem::path> table; ///< .csv, a row per branch
  std::vector<std::string>             also;  ///< further files beside the result: csv, swc, mrk.json, graphml, ma
};

/** "top", "thickest" or "x,y,z" in LPS mm. \throws UsageError */
RootChoice
ParseRoot(const std::string & text);

/** The inverse of ParseRoot. */
std::string
RootText(const RootChoice & root);

/** Fills pruneLength or pruneRadii from "5mm", "8vox", "2%" or "1.5r". \throws UsageError */
void
ParseBranchLimit(const std::string & text, BranchRequest & request);

/** Comma-separated endings. \throws UsageError for one that is not known */
std::vector<std::string>
ParseAlso(const std::string & text);

} // namespace voxelcore
