#pragma once
// Where a job's skeletons go besides the result.

#include "voxelcore/LambdaPruning.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace voxelcore
{

struct SkeletonTargets
{
  std::optional<std::filesystem::path> table; ///< .csv, a row per branch
  std::vector<std::string>             also;  ///< further files beside the result: csv, swc, mrk.json, graphml, ma
  bool                                 network = false; ///< of a network: tables have that of its contacts, too

  /** Sections of the body along branches, so far apart; 0: at each point. Of scans, into one file. */
  std::optional<Lambda> sections{};

  /** Whether anything is asked of the bodies around skeletons. */
  bool
  NeedsBodies() const
  {
    return sections.has_value();
  }
};

/** Comma-separated endings for `also`. \throws UsageError for one that is not known */
std::vector<std::string>
ParseAlso(const std::string & text);

} // namespace voxelcore
