#pragma once
// `voxelcore compare`: two masks, skeletons or medial surfaces against each other. A is the reference.

#include "voxelcore/Compare/CompareTables.h"
#include "voxelcore/Jobs/DisplayTargets.h"
#include "voxelcore/Jobs/JobContext.h"
#include "voxelcore/Jobs/SkeletonJob.h"
#include "voxelcore/Models/MedialModel.h"
#include "voxelcore/Models/SkeletonModel.h"

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace voxelcore
{

struct CompareOptions
{
  std::filesystem::path                a; ///< a scan, a .vtp of `skeleton` or `core`, .swc .rsml .graphml
  std::filesystem::path                b;
  SkeletonOptions                      making;       ///< how scans are read, and how their skeletons are made
  bool                                 lines = true; ///< of masks, too, what needs their skeletons
  std::optional<Lambda>                near;         ///< TreeTolerance::least, and of what medial surfaces cover
  std::optional<std::filesystem::path> output{};     ///< .vtp: branches of trees with what was found
  std::optional<std::filesystem::path> table{};      ///< .csv
  DisplayTargets                       display{};    ///< of trees: found, missed and invented branches
  std::optional<std::filesystem::path> report{};     ///< .json
  bool                                 force = false;
  std::string                          command{}; ///< only recorded
};

/** One of the two. */
struct CompareSide
{
  std::string                                        name; ///< of the file, for messages
  std::variant<LabelMap, SkeletonModel, MedialModel> content;
};

struct CompareResult
{
  std::string               kind; ///< "masks", "skeletons" or "cores"
  SpatialUnit               unit = SpatialUnit::Millimetres;
  std::vector<CompareTable> tables;
  std::vector<std::string>  warnings;
  std::vector<std::string>  notes;

  std::array<std::string, 2> sha256; ///< of A's and B's files, where a report of them is written

  SkeletonModel treesA; ///< the skeletons that were compared, by the rows of "labels"
  SkeletonModel treesB;
  std::vector<std::array<std::vector<BranchMatch>, 2>> matches; ///< of their branches
};

/** Reads a file as one side. Adds to `warnings` what a user must be told. \throws InputError, Cancelled */
CompareSide
ReadCompareSide(const std::filesystem::path & path,
                const CompareOptions &        options,
                std::vector<std::string> &    warnings,
                const ProgressCallback &      progress = {});

/** Compares what is in memory; of the options only `making`, `lines` and `near` count.
 *
 *  Masks are compared label by label: those of one value, or the only one of each. Their grids must be the same, or
 *  differ in their boxes alone: then in what both hold. Skeletons are compared label by label, too; those of SWC and
 *  RSML have no labels, and are compared with all of the other. A mask is compared with a tree by its skeleton.
 *  \throws InputError, UsageError, CertificateError, Cancelled */
CompareResult
Compare(CompareSide a, CompareSide b, const CompareOptions & options, const ProgressCallback & progress = {});

/** Reads, compares, writes. With `table` the tables of differences, branches and levels go beside it, and
 *  OUT_columns.json. \throws as Compare, and OutputError */
CompareResult
RunCompareJob(const CompareOptions & options, const JobContext & context = {});

/** The report: program, command, names, and the tables. */
std::string
CompareJson(const CompareResult & result, const CompareOptions & options);

std::string
CompareText(const CompareResult & result);

} // namespace voxelcore
