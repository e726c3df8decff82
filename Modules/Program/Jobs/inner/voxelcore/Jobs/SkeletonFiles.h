#pragma once
// The files a job about skeletons writes.

#include "voxelcore/Jobs/OutputTransaction.h"
#include "voxelcore/Jobs/SkeletonTargets.h"
#include "voxelcore/Models/MedialModel.h"
#include "voxelcore/Models/SkeletonModel.h"
#include "voxelcore/Report/CoreReport.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace voxelcore
{

/** Takes the labels' skeletons, then writes all files. Names beside "OUT.vtp": OUT_branches.csv and OUT_summary.csv for
 *  csv (with --table that file takes the place of OUT_branches.csv), of a network OUT_contacts.csv; OUT_columns.json,
 *  which says what the columns of all tables OUT_... mean; OUT.swc, OUT.mrk.json, OUT.graphml, OUT.obj, OUT.ma with
 *  OUT.r for the others, and the folder OUT_precomputed with a file a label. In a folder there is an OUT for each
 *  label, SkeletonFolderPath(); the tables, all labels in one, are called "<scan>_skeleton_branches.csv" and so on. */
class SkeletonFiles
{
public:
  /** Checks that all files can be written whose names are known. An output that ends in .csv means tables alone.
   *  \throws UsageError for an extension that is not known; OutputError */
  SkeletonFiles(std::filesystem::path output,
                std::filesystem::path input,
                SkeletonTargets       wanted,
                OutputTransaction &   transaction);

  /** Whether Add() wants the medial surface, for .ma. */
  bool
  NeedsSurface() const
  {
    return Wants("ma");
  }

  /** Takes the skeleton of label number `label` of the report and enters the file's name there; in a folder it goes to
   *  disk at once. Adds to notes what a user must be told. */
  void
  Add(CoreReport & report, std::size_t label, SkeletonPart part, ModelPart surface, std::vector<std::string> & notes);

  /** The same for one that is in its folder already; fills in what the report says of it. */
  void
  AddFinished(CoreReport & report, std::size_t label);

  /** What else is written for a label, for its key. */
  const std::vector<std::string> &
  Endings() const
  {
    return m_Targets.also;
  }

  /** The skeleton of a label of a folder. */
  std::filesystem::path
  FolderTarget(std::int64_t label, std::int64_t component) const;

  /** The tables of all labels of a folder. */
  std::vector<std::filesystem::path>
  FolderTables() const;

  /** Writes what is left to be written. */
  void
  Finish(const CoreReport & report, std::vector<std::string> & notes);

  /** \throws InputError where a file cannot have lengths in this unit */
  void
  RequireUnit(SpatialUnit unit) const;

private:
  bool
  IsFlowJson() const;
  bool
  IsFlowYaml() const;
  std::filesystem::path
  BesideFlow(const char * ending) const;
  /** All that WriteFlow() writes. */
  std::vector<std::filesystem::path>
  FlowTargets() const;
  void
  WriteFlow(const CoreReport & report);
  /** Files that say what columns of tables mean, each with its text. */
  std::map<std::filesystem::path, std::string>
  Columns(SpatialUnit unit) const;
  HeadUnits
  Heads(SpatialUnit unit) const
  {
    return m_Targets.units ? HeadUnits(unit) : HeadUnits();
  }
  bool
  Wants(const std::string & ending) const;
  std::vector<std::filesystem::path>
  Beside(const std::filesystem::path & output, const std::string & ending) const;
  void
  WriteGroup(const CoreReport &               report,
             const std::filesystem::path &    output,
             const std::vector<std::size_t> & labels,
             std::vector<std::string> &       notes);
  void
  WriteTables(const std::filesystem::path & output, const SkeletonModel & model);
  std::filesystem::path
  PrecomputedFolder() const;
  void
  WritePrecomputed(const SkeletonModel & model);

  std::filesystem::path    m_Output;
  std::filesystem::path    m_Input;
  bool                     m_ToFolder;
  SkeletonTargets          m_Targets;
  OutputTransaction &      m_Transaction;
  SkeletonModel            m_Model; ///< not written yet
  bool                     m_HasLives = false;
  bool                     m_HasNames = false;
  MedialModel              m_Surfaces;  ///< not written yet, for .ma
  SkeletonModel            m_AllLabels; ///< for tables of a folder
  std::vector<std::size_t> m_Labels;    ///< of m_Model, in the report
};

} // namespace voxelcore
