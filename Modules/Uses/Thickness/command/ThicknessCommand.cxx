// `voxelcore thickness`: its options, and what it runs.

#include "voxelcore/Thickness/ThicknessCommand.h"

#include "voxelcore/Certified/Certified.h"
#include "voxelcore/Jobs/OutputNames.h"
#include "voxelcore/Jobs/ReadInput.h"
#include "voxelcore/Options/FieldReader.h"
#include "voxelcore/Options/ParameterReader.h"
#include "voxelcore/Options/SharedRows.h"
#include "voxelcore/Options/SharedValues.h"

namespace voxelcore
{

namespace table
{

constexpr auto kThicknessOwn = std::to_array<Parameter>({
  { "output",
    "-o,--output",
    Output,
    "OUT",
    "",
    true,
    Group::Output,
    "Write the map: .nrrd .nii .nii.gz .mha .mhd .tif .ome.zarr; a folder, DIR/, gets one .nrrd per label" },
  { "table",
    "--table",
    Output,
    "OUT.csv",
    "",
    false,
    Group::Output,
    "Write a table with a row per label: mean, spread, quantiles; OUT_histogram.csv and OUT_columns.json go beside" },
  { "surface",
    "--surface",
    Output,
    "OUT.vtp",
    "",
    false,
    Group::Output,
    "Write the surface of the labels with the thickness at each point, which 'voxelcore render' can show" },
  { "medial",
    "--medial",
    Output,
    "OUT.vtp",
    "",
    false,
    Group::Output,
    "Write the medial surface with the thickness at each point, which 'voxelcore render' can show" },
  { "memory",
    "--memory",
    Text,
    "8GB",
    "",
    false,
    Group::Thickness,
    "Measure labels block by block if they need more memory than this; default: the machine's memory",
    "-",
    false,
    true },
  { "bounds",
    "--bounds",
    Flag,
    "",
    "",
    false,
    Group::Thickness,
    "Write OUT_lower and OUT_upper, too: the largest ball that truly lies in the voxels, and a proven upper bound" },
  { "border",
    "--border",
    Choice,
    "flag|keep|drop",
    "flag",
    false,
    Group::Thickness,
    "Voxels whose ball touches the border of the scan: count them and give the numbers without them, too; just count "
    "them; or leave them out" },
  { "separation",
    "--separation",
    Choice,
    "off|box|hull",
    "off",
    false,
    Group::Thickness,
    "Measure the background, too, within the box around the labels or their convex hull (Tb.Sp, pore size): "
    "OUT_separation" },
  { "within",
    "--within",
    Text,
    "LABEL|MASK",
    "",
    false,
    Group::Thickness,
    "Measure the background, too, within another label of the scan, or a mask of the same voxels: OUT_separation" },
  { "tolerance",
    "--tolerance",
    Text,
    "H",
    "1.2diag",
    false,
    Group::Pruning,
    "Prune the medial surface beside the map so that the boundary stays within H of the remaining balls: 1.2diag "
    "(voxel diagonals), 2vox, 1.5mm; the map does not depend on it" },
});

constexpr auto kThicknessRows = Joined(kRunRows,
                                       kScanArgument,
                                       kJoinRows,
                                       kScanRows,
                                       kThicknessOwn,
                                       kResolutionRows,
                                       kCavityRows,
                                       kTreeRows,
                                       kReportRows,
                                       kTableRows,
                                       kDisplayRows,
                                       kTriangleRows,
                                       kForceRows,
                                       kRefinedRows,
                                       kGreyRows,
                                       kEngineRows);

} // namespace table

namespace
{

constexpr std::string_view kFooter =
  R"(The map holds, at each voxel, the diameter of the largest ball inside the label that holds the voxel's centre
(Hildebrand, Rueegsegger 1997), in mm, and 0 outside. Slices of any thickness are measured as they are.

The balls are inscribed in the smooth surface that the voxels stand for. A voxel whose centre lies in none of them
takes the thickness of the nearest voxel that does. With --refine off they are balls that truly lie in the voxels, steps
and all, which makes everything thinner. Pruning changes neither. --bounds adds two maps: every smooth surface that the
labels allow is at least as thick as the first tells, and at most as the second. With --refine off they are bounds of
the voxels as they are.

Each label is measured by itself. One too large for memory is measured block by block, with the same map. Guide:
thickness.md

Examples:
  voxelcore thickness bone.nrrd -o bone-thickness.nrrd --table bone.csv
  voxelcore thickness ct.nrrd --threshold 300:inf --separation box -o map.nii.gz --table trabeculae.csv
  voxelcore thickness atlas.nii.gz --labels 4 -o cortex.nrrd --border drop
  voxelcore thickness atlas.nii.gz -o maps/ --table maps/thickness.csv)";

} // namespace

ThicknessOptions
ThicknessOptionsWithoutFiles(const ParameterValues & values)
{
  const ParameterReader reader(values, kThicknessCommand);
  ThicknessOptions      options;
  options.core = MapOptionsFrom(reader);
  options.bounds = reader.IsSet("bounds");
  const std::string border = reader.Choice("border");
  options.border = border == "keep" ? BorderRule::Keep : border == "drop" ? BorderRule::Drop : BorderRule::Flag;
  const std::string separation = reader.Choice("separation");
  options.separation = separation == "box"    ? SeparationRegion::Box
                       : separation == "hull" ? SeparationRegion::Hull
                                              : SeparationRegion::None;
  if (reader.IsGiven("within"))
  {
    options.within = reader.Text("within");
    if (options.within.empty())
    {
      reader.ThrowUsageError("within", "a label of the scan, or the file of a mask");
    }
    if (options.separation != SeparationRegion::None)
    {
      reader.ThrowUsageError("within", "no --separation beside it");
    }
    options.separation = SeparationRegion::Within;
  }
  return options;
}

ThicknessOptions
ThicknessOptionsFrom(const ParameterValues & values)
{
  const ParameterReader reader(values, kThicknessCommand);
  ThicknessOptions      options = ThicknessOptionsWithoutFiles(values);
  ReadMapFiles(reader, options.core);
  options.output = reader.File("output");
  options.table = reader.FileIfGiven("table");
  options.surface = reader.FileIfGiven("surface");
  options.medial = reader.FileIfGiven("medial");
  options.core.display = DisplayTargetsFrom(values);
  if (reader.IsGiven("memory"))
  {
    options.core.memory = ParseMemory(reader.Text("memory"));
  }
  return options;
}

namespace
{

std::vector<std::string>
CaseArguments(const CasePlace & place)
{
  return { "-o",       place.Stem() + (place.bids ? "_thickness.nii.gz" : "_thickness.nrrd"),
           "--table",  place.Stem() + "_thickness.csv",
           "--report", place.Stem() + "_report.json" };
}

CaseInput
Understand(const ParameterValues & values)
{
  const ThicknessOptions options = ThicknessOptionsFrom(values);
  CaseInput              input{ options.core.reading, {} };
  if (NamesFile(options.within))
  {
    input.masks.emplace_back(options.within);
  }
  return input;
}

constexpr AsCase kAsCase{
  .arguments = CaseArguments,
  .understand = Understand,
  .flag = "--thickness",
  .description =
    "Run 'voxelcore thickness' on each scan, with the options of that command: a map per case; compare "
    "scans by their numbers",
};

Outcome
Run(const Invocation & call)
{
  ThicknessOptions options = ThicknessOptionsFrom(call.values);
  options.core.threads = call.threads;
  options.core.command = call.whole;
  const ThicknessResult result = RunThicknessJob(options, call.context);
  return { .warnings = result.warnings, .text = ThicknessText(result), .notes = result.notes };
}

} // namespace

constinit const Command kThicknessCommand{ .name = "thickness",
                                           .description = "Measure the local thickness of labels at every voxel",
                                           .footer = kFooter,
                                           .place = 40,
                                           .rows = table::kThicknessRows,
                                           .run = Run,
                                           .asCase = &kAsCase };

} // namespace voxelcore
