#include "voxelcore/Corrections/CorrectionsExtension.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Options/CommandTable.h"
#include "voxelcore/Options/ParameterReader.h"
#include "voxelcore/Options/Requests.h"
#include "voxelcore/Report/ReportTable.h"

namespace voxelcore
{

namespace table
{

constexpr auto kCorrectionsRows = std::to_array<Parameter>({
  { "annotations",
    "--annotations",
    Flag,
    "",
    "",
    false,
    Group::Skeleton,
    "Write OUT_annotations.csv and OUT_annotations.mrk.json, a row a branch and a junction, for --edits",
    "-" },
  { "edits",
    "--edits",
    Input,
    "FILE",
    "",
    false,
    Group::Skeleton,
    "Edit the body as OUT_annotations.csv or .mrk.json of an earlier run, or a page of --html, says: cut, remove, join "
    "X Y Z, path X Y Z; .., root, loop, background",
    "edits" },
});

} // namespace table

CorrectionsOptions
CorrectionsOptionsFrom(const ParameterValues & values)
{
  const ParameterReader reader(values, table::kCorrectionsRows);
  for (const char * other : { "network", "split-components", "split-at-junctions" })
  {
    if (reader.IsGiven(other))
    {
      throw UsageError("--edits and --annotations are of one body; leave out --" + std::string(other));
    }
  }
  return { SkeletonOptionsFrom(values), reader.FileIfGiven("edits") };
}

namespace
{

bool
IsAsked(const ParameterValues & values)
{
  return values.contains("edits") || values.contains("annotations");
}

Outcome
Run(const Invocation & call)
{
  CorrectionsOptions options = CorrectionsOptionsFrom(call.values);
  options.making.threads = call.threads;
  options.making.command = call.whole;
  const SkeletonResult result = RunCorrectionsJob(options, call.context);
  return { .warnings = result.warnings, .text = SkeletonTable(result.report), .notes = result.notes };
}

} // namespace

constinit const Extension kCorrectionsExtension{ .command = "skeleton",
                                                 .rows = table::kCorrectionsRows,
                                                 .isAsked = IsAsked,
                                                 .run = Run };

} // namespace voxelcore
