#pragma once
// `voxelcore verify`: a finished file rechecked against its scan.

#include "voxelcore/Jobs/JobContext.h"
#include "voxelcore/Jobs/ReadInput.h"
#include "voxelcore/Models/MedialModel.h"
#include "voxelcore/Report/CoreReport.h"
#include "voxelcore/Verification/Verification.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace voxelcore
{

struct VerifyOptions
{
  std::filesystem::path scan;
  std::filesystem::path core; ///< .vtp
};

struct LabelVerification
{
  std::int64_t       label = 0;
  std::string        name;
  double             lambdaMm = 0;
  std::string        pruningTolerance; ///< as given; empty when pruned by lambda
  double             toleranceMm = 0;
  VerificationReport report;
};

struct VerifyResult
{
  bool                           passed = true;
  std::vector<std::string>       notes;    ///< e.g. that the scan's file is not the one the core was made from
  std::vector<std::string>       warnings; ///< about the scan; a user must see them
  std::vector<LabelVerification> labels;
  SpatialUnit                    unit = SpatialUnit::Millimetres; ///< of all lengths
};

/** Reads the scan with the options recorded in the file and checks label by label.
 *  \throws InputError when either cannot be read or a label is missing in the scan; Cancelled */
VerifyResult
RunVerifyJob(const VerifyOptions & options, const JobContext & context = {});

/** The same of a core in memory, made as `made` says, and a scan read as that says; `names` is what messages call them.
 *  \throws InputError when they do not belong together; Cancelled */
VerifyResult
VerifyModel(MedialModel              model,
            const CoreReport &       made,
            InputScan                volume,
            const VerifyOptions &    names,
            const ProgressCallback & progress = {});

/** A line per label, with tolerances also how far the boundary lies from it, and check; with one label per check,
 *  otherwise failed checks only. */
std::string
VerifyText(const VerifyResult & result);

} // namespace voxelcore
