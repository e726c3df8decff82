// `voxelcore sheets`: its options, and what it runs.

#include "voxelcore/Sheets/SheetsCommand.h"

#include "voxelcore/Options/ParameterReader.h"
#include "voxelcore/Options/SharedRows.h"
#include "voxelcore/Options/SharedValues.h"

namespace voxelcore
{

namespace table
{

constexpr auto kSheetsOwn = std::to_array<Parameter>({
  { "output",
    "-o,--output",
    Output,
    "OUT.vtp",
    "",
    true,
    Group::Output,
    "Write the medial surface with its sheets, seams and junctions" },
  { "voxels",
    "--voxels",
    Output,
    "OUT.nrrd",
    "",
    false,
    Group::Output,
    "Write a volume with the number of the sheet or rod each voxel belongs to: .nrrd .nii .nii.gz .mha .mhd .tif "
    ".ome.zarr" },
  { "graph",
    "--graph",
    Output,
    "OUT.graphml",
    "",
    false,
    Group::Output,
    "Write a graph of sheets, seams, rods and junctions" },
  { "table",
    "--table",
    Output,
    "OUT.csv",
    "",
    false,
    Group::Output,
    "Write a table with a row per sheet and rod; OUT_seams.csv and OUT_columns.json go beside" },
  { "sliver",
    "--sliver",
    Text,
    "L",
    "3vox",
    false,
    Group::Thickness,
    "Join sheets that stand out from their seams by less than L to the sheet they continue: 1.5mm, 3vox, 2.5%" },
  { "tolerance",
    "--tolerance",
    Text,
    "H",
    "1.2diag",
    false,
    Group::Pruning,
    "Prune the surface of a scan first so that the boundary stays within H of the remaining balls: 1.2diag (voxel "
    "diagonals), 2vox, 1.5mm" },
});

constexpr auto kSheetsRows = Joined(kRunRows,
                                    kScanOrCoreArgument,
                                    kJoinRows,
                                    kScanRows,
                                    kSheetsOwn,
                                    kResolutionRows,
                                    kCavityRows,
                                    kTreeRows,
                                    kReportRows,
                                    kTableRows,
                                    kForceRows,
                                    kRefinedRows,
                                    kGreyRows,
                                    kEngineRows);

} // namespace table

namespace
{

constexpr std::string_view kFooter =
  R"(A sheet is a piece of the medial surface without branching: the middle of one wall. Sheets meet in seams, and
seams in junctions. What is a line and no surface is a rod. Walls, plates and struts get numbers of their own.

Noise makes small sheets. One that stands out from its seams by less than --sliver is joined to the sheet it
continues, and a seam shorter than that is drawn together into one junction.

--voxels gives each voxel the number of the sheet or rod whose ball gives it its thickness. The volumes add up to the
label's. Guide: sheets.md

Examples:
  voxelcore sheets atlas.nii.gz --labels 4 -o sheets.vtp --table sheets.csv --graph sheets.graphml
  voxelcore sheets bone.nrrd -o sheets.vtp --voxels sheets.nii.gz --table sheets.csv
  voxelcore sheets core.vtp -o sheets.vtp --sliver 0.5mm)";

} // namespace

SheetsOptions
SheetsOptionsFrom(const ParameterValues & values)
{
  const ParameterReader reader(values, kSheetsCommand);
  SheetsOptions         options;
  if (std::filesystem::path(reader.Text("scan")).extension() == ".vtp" && !reader.FirstResolution())
  {
    RefuseScanOptions(values, reader.Text("scan"), kSheetsCommand);
  }
  options.core = MapOptionsFrom(reader);
  ReadMapFiles(reader, options.core);
  options.sliver = reader.Parsed("sliver", [](const std::string & text) { return ParseLambda(text, "length"); });
  options.output = reader.File("output");
  options.voxels = reader.FileIfGiven("voxels");
  options.table = reader.FileIfGiven("table");
  options.graph = reader.FileIfGiven("graph");
  return options;
}

namespace
{

Outcome
Run(const Invocation & call)
{
  SheetsOptions options = SheetsOptionsFrom(call.values);
  options.core.threads = call.threads;
  options.core.command = call.whole;
  const SheetsResult result = RunSheetsJob(options, call.context);
  return { .warnings = result.warnings, .text = SheetsText(result), .notes = result.notes };
}

} // namespace

constinit const Command kSheetsCommand{ .name = "sheets",
                                        .description =
                                          "Cut medial surfaces into sheets, seams and rods, and measure them",
                                        .footer = kFooter,
                                        .place = 50,
                                        .rows = table::kSheetsRows,
                                        .run = Run };

} // namespace voxelcore
