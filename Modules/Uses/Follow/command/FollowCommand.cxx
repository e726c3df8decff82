// `voxelcore follow`: its options, and what it runs.

#include "voxelcore/Follow/FollowCommand.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Options/FieldReader.h"
#include "voxelcore/Options/ParameterReader.h"
#include "voxelcore/Options/Requests.h"
#include "voxelcore/Options/SharedRows.h"

namespace voxelcore
{

namespace table
{

constexpr auto kFollowOwn = std::to_array<Parameter>({
  { "days",
    "",
    Inputs,
    "DAY...",
    "",
    true,
    Group::Input,
    "The days in order: masks, or skeletons (.vtp .swc .rsml .graphml)" },
  { "report", "--report", Output, "OUT.json", "", false, Group::Output, "Write all tables as JSON" },
  { "times",
    "--times",
    Text,
    "T,T,..",
    "",
    false,
    Group::Comparison,
    "When the days were, in any unit, such as 0,7,14; default: 1,2,..; growth is by this unit",
    "-" },
  { "motion",
    "--motion",
    Choice,
    "find|none",
    "find",
    false,
    Group::Comparison,
    "Find how the body has moved between days, or take it where it is",
    "-" },
  { "near",
    "--near",
    Text,
    "L",
    "",
    false,
    Group::Comparison,
    "Take lines up to L apart for the same, such as 1mm, where the radius is less; default: a voxel's diagonal",
    "-" },
});

constexpr auto kFollowRows =
  Joined(kRunRows, kFollowOwn, kFolderOutput, kLabelRows, kShapeRows, kValueRows, kTableRows, kForceRows, kRootRows);

} // namespace table

namespace
{

constexpr std::string_view kFooter =
  R"(Each day's certified skeleton is moved onto the day before. A branch is the way from its base to its tip. It keeps
its number while it grows, and where others spring from it. OUTDIR/branches.csv has a row per branch and day: length,
growth, radius and its change, tip, and state: kept, new, lost, or back. days.csv has the motions and sums,
identities.vtp all days in the space of the first, for colours by Id or Day. day-N.rsml are one time sequence.

A day of which less than half is found again ends the run; --near allows for more deformation. Noisy masks need
--largest 1 and --mend-shape. Guide: compare.md

Examples:
  voxelcore follow day0.nii.gz day7.nii.gz --times 0,7 --root top -o followed/
  voxelcore follow before.vtp after.vtp --near 2mm -o patient/ --report patient.json)";

} // namespace

FollowOptions
FollowOptionsFrom(const ParameterValues & values)
{
  const ParameterReader reader(values, kFollowCommand);
  FollowOptions         options;
  for (const std::string & day : SplitText(reader.Text("days"), '\n'))
  {
    options.days.emplace_back(day);
  }
  // Skeletons are made as `voxelcore skeleton` makes them where nothing is said.
  options.making =
    SkeletonOptionsFrom({ { "scan", "a scan" }, { "output", "skeleton.vtp" }, { "root", reader.Text("root") } });
  ReadScanFields(reader, options.making);
  if (reader.IsSet("split-components"))
  {
    throw UsageError("--split-components: a day is followed as one body; leave it out");
  }
  if (reader.IsGiven("times"))
  {
    for (const std::string & text : SplitText(reader.Text("times"), ','))
    {
      const auto time = ParseReal(text);
      if (!time || !std::isfinite(*time))
      {
        reader.ThrowUsageError("times", "numbers with commas, such as 0,7,14");
      }
      options.times.push_back(*time);
    }
  }
  if (reader.IsGiven("near"))
  {
    options.near = reader.Parsed("near", [](const std::string & text) { return ParseLambda(text, "length"); });
  }
  options.still = reader.Choice("motion") == "none";
  options.output = reader.File("output");
  options.report = reader.FileIfGiven("report");
  options.force = reader.IsSet("force");
  return options;
}

namespace
{

Outcome
Run(const Invocation & call)
{
  FollowOptions options = FollowOptionsFrom(call.values);
  options.command = call.whole;
  const FollowResult result = RunFollowJob(options, call.context);
  return { .warnings = result.warnings, .text = FollowText(result) };
}

} // namespace

constinit const Command kFollowCommand{ .name = "follow",
                                        .description = "Follow the branches of roots or vessels over time",
                                        .footer = kFooter,
                                        .place = 115,
                                        .rows = table::kFollowRows,
                                        .run = Run };

} // namespace voxelcore
