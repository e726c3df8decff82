#pragma once
// Where a job's skeletons go besides the result.

#include "voxelcore/Lattice/ImageGeometry.h"
#include "voxelcore/Skeleton/SomaTree.h"
#include "voxelcore/VoxelCore/LambdaPruning.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace voxelcore
{

struct SkeletonTargets
{
  std::optional<std::filesystem::path> table; ///< .csv, a row per branch
  std::vector<std::string> also; ///< further files beside the result: csv, swc, mrk.json, graphml, obj, precomputed, ma
  bool                     network = false; ///< of a network: tables have that of its contacts, too
  bool                     units = false;   ///< columns of tables are called "length [mm]"

  /** Sections of the body along branches, so far apart; 0: at each point. Of scans, into one file. */
  std::optional<Lambda> sections{};

  // Volumes on the scan's grid, of scans: of each voxel the row of its branch in the table of branches, from 1; the
  // Strahler order of that; and the label of the skeleton, where that runs.
  std::optional<std::filesystem::path> branchMap{};
  std::optional<std::filesystem::path> orderMap{};
  std::optional<std::filesystem::path> skeletonMap{};

  std::optional<std::filesystem::path> centerlines{}; ///< .vtp, as VMTK has them
  std::optional<std::filesystem::path>
                       flow{};   ///< .csv with a table of nodes, .json for svZeroDSolver, or .yaml for openBF
  std::vector<Vector3> inlets{}; ///< of both, LPS mm

  std::optional<SomaChoice> soma{}; ///< where the SWC begins

  /** The option that asks for something of the bodies around skeletons; empty: none does. */
  std::string_view
  NeedsBodies() const
  {
    return sections      ? "--sections"
           : branchMap   ? "--branch-map"
           : orderMap    ? "--order-map"
           : skeletonMap ? "--skeleton-map"
                         : "";
  }

  /** The option for which all labels go into one file; empty: none. */
  std::string_view
  NeedsOneFile() const
  {
    return !NeedsBodies().empty() ? NeedsBodies() : centerlines ? "--centerlines" : flow ? "--flow" : "";
  }
};

/** Comma-separated endings for `also`. \throws UsageError for one that is not known */
std::vector<std::string>
ParseAlso(const std::string & text);

} // namespace voxelcore
