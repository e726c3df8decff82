// `voxelcore compare`: its options, and what it runs.

#include "voxelcore/Compare/CompareCommand.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Options/FieldReader.h"
#include "voxelcore/Options/ParameterReader.h"
#include "voxelcore/Options/Requests.h"
#include "voxelcore/Options/SharedRows.h"

namespace voxelcore
{

namespace table
{

constexpr auto kCompareOwn = std::to_array<Parameter>({
  { "a",
    "",
    Input,
    "A",
    "",
    true,
    Group::Input,
    "The reference: a scan with labels, a skeleton (.vtp .swc .rsml .graphml) or a medial surface (.vtp)" },
  { "b", "", Input, "B", "", true, Group::Input, "What is compared with it" },
  { "output",
    "-o,--output",
    Output,
    "OUT.vtp",
    "",
    false,
    Group::Output,
    "Write the branches of skeletons, coloured by Found: 0 found, 1 missed, 2 invented" },
  { "report", "--report", Output, "OUT.json", "", false, Group::Output, "Write all tables as JSON" },
  { "table",
    "--table",
    Output,
    "OUT.csv",
    "",
    false,
    Group::Output,
    "Write a table with a row per label; OUT_differences.csv, of skeletons OUT_branches.csv and OUT_levels.csv, and "
    "OUT_columns.json go beside" },
  { "near",
    "--near",
    Text,
    "L",
    "",
    false,
    Group::Comparison,
    "Skeletons: count places as found up to L apart, such as 1mm, where A's radius is less; surfaces: count as covered "
    "what lies within L of the other" },
  { "no-skeletons",
    "--no-skeletons",
    Flag,
    "",
    "",
    false,
    Group::Comparison,
    "Masks: leave out what needs their skeletons: clDice, detected branches and length, loops that differ" },
});

constexpr auto kCompareRows =
  Joined(kRunRows, kCompareOwn, kLabelRows, kValueRows, kTableRows, kDisplayRows, kTriangleRows, kForceRows);

} // namespace table

namespace
{

constexpr std::string_view kFooter =
  R"(A is the reference. Two masks on one grid get, label by label, Dice, distances of their surfaces, topology numbers
(6- and 26-connected) with their differences, clDice of their certified skeletons, and the pieces, loops and cavities
that differ, with places. Where only their boxes differ, what both hold is compared.

Two skeletons get branches and length detected, leakage, tips and bifurcations found, missed and invented, and
distances of axes and radii. A place is found where the other axis passes within A's radius there; a branch where one
connected run of the other follows 80 % of it. A mask is compared with a skeleton by its own skeleton. Two medial
surfaces get distances and coverage. Guide: compare.md

Examples:
  voxelcore compare truth.nii.gz network.nii.gz --table compared.csv
  voxelcore compare truth.nii.gz network.nii.gz --labels 1 --no-skeletons --report compared.json
  voxelcore compare traced.swc aorta.vtp -o found.vtp --table trees.csv
  voxelcore compare core.vtp medial.vtp --near 0.5mm)";

} // namespace

CompareOptions
CompareOptionsWithoutFiles(const ParameterValues & values)
{
  const ParameterReader reader(values, kCompareCommand);
  CompareOptions        options;
  // Skeletons are made as `voxelcore skeleton` makes them where nothing is said.
  options.making = SkeletonOptionsFrom({ { "scan", "a scan" }, { "output", "skeleton.vtp" } });
  ReadScanFields(reader, options.making);
  options.making.reading.mayBeMissing = reader.IsGiven("labels");
  options.lines = !reader.IsSet("no-skeletons");
  if (reader.IsGiven("near"))
  {
    options.near = reader.Parsed("near", [](const std::string & text) { return ParseLambda(text, "length"); });
  }
  return options;
}

CompareOptions
CompareOptionsFrom(const ParameterValues & values)
{
  const ParameterReader reader(values, kCompareCommand);
  CompareOptions        options = CompareOptionsWithoutFiles(values);
  options.a = reader.File("a");
  options.b = reader.File("b");
  options.output = reader.FileIfGiven("output");
  options.table = reader.FileIfGiven("table");
  options.report = reader.FileIfGiven("report");
  options.display = DisplayTargetsFrom(values);
  options.force = reader.IsSet("force");
  return options;
}

namespace
{

std::vector<std::string>
CaseArguments(const CasePlace & place)
{
  return { "--table", place.Stem() + "_compared.csv", "--report", place.Stem() + "_report.json" };
}

CaseInput
Understand(const ParameterValues & values)
{
  const auto b = values.find("b");
  if (b == values.end())
  {
    throw UsageError("what to compare it with is missing; give a manifest.csv with the columns id, scan and b");
  }
  return { CompareOptionsWithoutFiles(values).making.reading, { b->second } };
}

constexpr AsCase kAsCase{
  .arguments = CaseArguments,
  .understand = Understand,
  .flag = "--compare",
  .description =
    "Run 'voxelcore compare' on each scan and the file in the manifest's column b; means.csv holds means "
    "and intervals",
  .hasBids = false,
  .beside = "b",
};

Outcome
Run(const Invocation & call)
{
  CompareOptions options = CompareOptionsFrom(call.values);
  options.command = call.whole;
  const CompareResult result = RunCompareJob(options, call.context);
  return { .warnings = result.warnings, .text = CompareText(result), .notes = result.notes };
}

} // namespace

constinit const Command kCompareCommand{ .name = "compare",
                                         .description = "Compare two masks, skeletons or medial surfaces",
                                         .footer = kFooter,
                                         .place = 110,
                                         .rows = table::kCompareRows,
                                         .run = Run,
                                         .asCase = &kAsCase };

} // namespace voxelcore
