#pragma once
// `voxelcore prune`: a finished core to other thresholds, without its scan.

#include "voxelcore/Jobs/JobContext.h"
#include "voxelcore/Report/CoreReport.h"
#include "voxelcore/VoxelCore/LambdaPruning.h"
#include "voxelcore/VoxelCore/TolerancePruning.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace voxelcore
{

struct PruneOptions
{
  std::filesystem::path                core;       ///< .vtp written with --keep-edges, or with tolerances
  std::vector<Lambda>                  lambdas;    ///< these or
  std::vector<Tolerance>               tolerances; ///< these
  std::filesystem::path                output;     ///< a model file
  std::optional<std::filesystem::path> report;
  ModelOptions                         model;
  int                                  threads = 0; ///< only recorded
  bool                                 force = false;
  std::string                          command; ///< only recorded
};

struct PruneResult
{
  CoreReport               report;
  std::vector<std::string> warnings; ///< a user must see them
  std::vector<std::string> notes;
};

/** Writes, to the last bit, what `voxelcore core` would have written at these thresholds.
 *  \throws InputError when the file lacks the measures of its edges or tolerances, or is pruned further than asked;
 *  and whatever RunCoreJob throws. */
PruneResult
RunPruneJob(const PruneOptions & options, const JobContext & context = {});

} // namespace voxelcore
