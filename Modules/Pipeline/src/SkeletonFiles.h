#pragma once
// The files a job about skeletons writes.

#include "voxelcore/MedialModel.h"
#include "voxelcore/OutputTransaction.h"
#include "voxelcore/SkeletonJob.h"
#include "voxelcore/TopologyNumbers.h"

#include <nlohmann/json.hpp>

#include <optional>

namespace voxelcore
{

/** Records the options that change a result. */
void
AddBranchOptions(nlohmann::ordered_json & json, const BranchOptions & options);

/** Collects parts, then writes all files. Names beside "OUT.vtp": OUT_branches.csv, OUT_summary.csv, OUT_columns.json for
 *  csv; OUT.swc, OUT.mrk.json, OUT.graphml, OUT.ma with OUT.r for the others. */
class SkeletonFiles
{
public:
  /** Checks that all files can be written. */
  SkeletonFiles(std::filesystem::path output, const BranchOptions & options, OutputTransaction & transaction);

  /** Does what the options ask for to the part's graph and measures it; keeps a copy of the surface when .ma is asked. */
  void
  Add(SkeletonPart part, const std::optional<TopologyNumbers> & shape, const ModelPart * surface);

  SkeletonResult
  Write();

  SkeletonModel            model;
  Vector3                  spacing{ 1, 1, 1 };
  std::vector<std::string> warnings;
  std::vector<std::string> notes;

private:
  /** Names of labels go into the provenance: a .vtp has no other place for them. */
  void
  AddNames();
  bool
  Wants(const std::string & ending) const;
  std::filesystem::path
  Beside(const std::string & ending) const;
  MeasureOptions
  Measuring() const;

  std::filesystem::path                       m_Output;
  BranchOptions                               m_Options;
  OutputTransaction &                         m_Transaction;
  MedialModel                                 m_Surfaces; ///< for .ma
  std::vector<std::optional<TopologyNumbers>> m_Shapes;
};

} // namespace voxelcore
