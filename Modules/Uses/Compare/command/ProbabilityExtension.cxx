// `voxelcore skeleton --probability`: its options, and what it runs.

#include "voxelcore/Compare/ProbabilityExtension.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/ParseReal.h"
#include "voxelcore/Options/CommandTable.h"
#include "voxelcore/Options/FieldReader.h"
#include "voxelcore/Options/Requests.h"
#include "voxelcore/Report/ReportTable.h"

namespace voxelcore
{

namespace table
{

constexpr auto kProbabilityRows = std::to_array<Parameter>({
  { "probability",
    "--probability",
    Flag,
    "",
    "",
    false,
    Group::Skeleton,
    "The scan is a map of probabilities, 0 to 1 or 0 to 255: make a skeleton at each of --thresholds, tell over which "
    "of them each branch lives, and choose a tree that keeps what is stable",
    "-",
    true },
  { "thresholds",
    "--thresholds",
    Text,
    "P,P,..",
    "0.1,0.2,0.3,0.4,0.5,0.6,0.7,0.8,0.9",
    false,
    Group::Skeleton,
    "Probabilities from which voxels are taken, for --probability",
    "-",
    true },
  { "persistence",
    "--persistence",
    Real,
    "P",
    "0.2",
    false,
    Group::Skeleton,
    "Take branches that live over at least so much of probability for stable, for --probability",
    "-",
    true },
});

} // namespace table

ProbabilityOptions
ProbabilityOptionsFrom(const ParameterValues & values)
{
  const ParameterReader reader(values, table::kProbabilityRows);
  for (const char * other : { "labels",
                              "binary",
                              "threshold",
                              "network",
                              "split-components",
                              "split-at-junctions",
                              "resolution",
                              "sections" })
  {
    if (reader.IsGiven(other))
    {
      throw UsageError("--probability takes a map at --thresholds; leave out --" + std::string(other));
    }
  }
  ProbabilityOptions options{ SkeletonOptionsFrom(values), ParseThresholds(reader.Text("thresholds")), 0 };
  options.making.further.merge(FurtherOptions(reader));
  const auto persistence = ParseReal(reader.Text("persistence"));
  if (!persistence || !(*persistence >= 0 && *persistence <= 1))
  {
    reader.ThrowUsageError("persistence", "a number from 0 to 1");
  }
  options.persistence = *persistence;
  return options;
}

namespace
{

bool
IsAsked(const ParameterValues & values)
{
  if (values.contains("probability"))
  {
    return true;
  }
  for (const char * option : { "thresholds", "persistence" })
  {
    if (values.contains(option))
    {
      throw UsageError("--" + std::string(option) + ": needs --probability");
    }
  }
  return false;
}

Outcome
Run(const Invocation & call)
{
  ProbabilityOptions options = ProbabilityOptionsFrom(call.values);
  options.making.threads = call.threads;
  options.making.command = call.whole;
  const ProbabilityResult result = RunProbabilityJob(options, call.context);
  return { .warnings = result.warnings,
           .text = ThresholdsText(result) + SkeletonTable(result.report),
           .notes = result.notes };
}

} // namespace

constinit const Extension kProbabilityExtension{ .command = "skeleton",
                                                 .rows = table::kProbabilityRows,
                                                 .isAsked = IsAsked,
                                                 .run = Run };

} // namespace voxelcore
