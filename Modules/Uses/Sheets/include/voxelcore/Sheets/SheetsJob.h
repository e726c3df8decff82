#pragma once
// `voxelcore sheets`: medial surfaces cut into sheets, seams and junctions.

#include "voxelcore/Jobs/CoreJob.h"
#include "voxelcore/Sheets/SheetFiles.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace voxelcore
{

struct SheetsOptions
{
  CoreOptions                          core;   ///< `scan` is a scan or mesh, or a .vtp that 'voxelcore core' wrote
  Lambda                               sliver; ///< MedialSheets.h; by InMeanVoxels()
  std::filesystem::path                output; ///< .vtp
  std::optional<std::filesystem::path> voxels; ///< a volume of the numbers of sheets and rods; needs a scan
  std::optional<std::filesystem::path> table;  ///< .csv: sheets; seams and a data dictionary go beside
  std::optional<std::filesystem::path> graph;  ///< .graphml
};

struct SheetsResult
{
  CoreReport               report;
  SheetModel               model;  ///< without cores
  std::vector<SheetTotals> totals; ///< per label of the report
  std::vector<std::string> warnings;
  std::vector<std::string> notes;
};

/** Everything is written or nothing; the same bits for every number of threads.
 *  \throws UsageError, InputError, OutputError, CertificateError, Cancelled */
SheetsResult
RunSheetsJob(const SheetsOptions & options, const JobContext & context = {});

/** A table for people. */
std::string
SheetsText(const SheetsResult & result);

} // namespace voxelcore
