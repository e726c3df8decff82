#pragma once
// `voxelcore batch`: a cohort of scans, each worked on by a process of its own.

#include "voxelcore/Cohort/Manifest.h"
#include "voxelcore/Jobs/JobContext.h"
#include "voxelcore/Options/Command.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace voxelcore
{

extern const Command kBatchCommand;

struct BatchOptions
{
  std::vector<std::filesystem::path> inputs;   ///< as FindCases takes them; may be empty for `gather`
  std::filesystem::path              output;   ///< the folder; made when it is not there
  ParameterValues                    values;   ///< options of the command for all cases; a case's own come first
  std::span<const Command>           commands; ///< all there are
  const Command *                    command = nullptr; ///< what each case is; it is `asCase`
  std::vector<Parameter>             rows;              ///< OptionsOfCases(commands)
  bool                               skeletons = true;
  bool                               pages = false;  ///< a page per case that shows it in 3-D (`core --html`)
  bool                               force = false;  ///< what is done is done again
  int                                jobs = 1;       ///< cases side by side
  int                                threads = 1;    ///< of each case
  double                             memoryMb = 0;   ///< for all cases that run, together
  double                             timeout = 0;    ///< seconds a case may take; 0: as long as it likes
  std::optional<std::size_t>         only;           ///< run this one of the cases, from 1, and write no tables
  bool                               bids = false;   ///< the results as a dataset of BIDS derivatives, too
  bool                               gather = false; ///< run nothing, write tables and page
};

struct FailedCase
{
  std::string id;
  std::string reason;          ///< one line
  bool        recorded = true; ///< in its folder, too
};

struct BatchResult
{
  std::size_t             cases = 0;
  std::size_t             kept = 0; ///< of these were done already
  std::vector<FailedCase> failed;
  double                  seconds = 0;

  std::vector<std::filesystem::path> passedOver; ///< files in the folders given that are no scans
};

/** \throws UsageError, InputError (the cases that were named) */
BatchOptions
BatchOptionsFrom(const ParameterValues & values, std::span<const Command> commands);

/** Works on every case that is not done, then writes the tables and the page (GatherCohort). A case that fails costs
 *  itself. Killed at any moment and run again it goes on with what is not done; several may work on one folder.
 *  Progress: the fraction of cases that are done; the stage says how many are done, running, failed, and the time left.
 *  \throws UsageError, InputError, OutputError for what concerns all cases; Cancelled: finished cases stay */
BatchResult
RunBatchJob(const BatchOptions & options, const JobContext & context = {});

/** A line per case: its number for `--case`, its folder, its id, its scan, separated by tabs. */
std::string
CaseList(const BatchOptions & options);

/** What to tell of a batch: a line, and one for each case that failed. */
std::string
BatchText(const BatchResult & result);

} // namespace voxelcore
