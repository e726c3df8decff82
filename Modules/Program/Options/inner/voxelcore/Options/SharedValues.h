#pragma once
// Values that several commands read alike.

#include "voxelcore/Options/ParameterReader.h"
#include "voxelcore/Options/Requests.h"

#include <filesystem>

namespace voxelcore
{

/** --stand-out, --smooth and --prune-branches; lambda is 0. \throws UsageError, naming the option */
SkeletonRequest
BurningFrom(const ParameterReader & reader);

/** --border */
BorderEnds
BorderFrom(const ParameterReader & reader);

/** --engine */
Engine
EngineFrom(const ParameterReader & reader);

/** What maps of labels are made of, without files: scan, edits, tolerance, refinement. */
CoreOptions
MapOptionsFrom(const ParameterReader & reader);

/** What is said of a core. */
Outcome
OutcomeOf(const CoreResult & result);

/** Their scan, report and --force. */
void
ReadMapFiles(const ParameterReader & reader, CoreOptions & core);

/** A finished core was read, edited and pruned already. \throws UsageError, naming an option given that is of scans */
void
RefuseScanOptions(const ParameterValues & values, const std::filesystem::path & input, const Command & command);

} // namespace voxelcore
