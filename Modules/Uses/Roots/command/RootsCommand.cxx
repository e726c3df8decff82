// `voxelcore roots`: its options, and what it runs.

#include "voxelcore/Roots/RootsCommand.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Options/FieldReader.h"
#include "voxelcore/Options/ParameterReader.h"
#include "voxelcore/Options/SharedRows.h"
#include "voxelcore/Options/SharedValues.h"
#include "voxelcore/Report/SkeletonTexts.h"

#include <vector>

namespace voxelcore
{

namespace table
{

constexpr auto kRootsOwn = std::to_array<Parameter>({
  { "up",
    "--up",
    Text,
    "auto|x+|x-|y+|y-|z+|z-",
    "auto",
    false,
    Group::Roots,
    "Direction that was up, along an axis of the scan's space (LPS); auto finds it by the stem" },
  { "stems",
    "--stems",
    Text,
    "N|auto",
    "1",
    false,
    Group::Roots,
    "Number of stems; auto counts those about as thick and high" },
  { "stem",
    "--stem",
    Text,
    "X,Y,Z[;X,Y,Z...]",
    "",
    false,
    Group::Roots,
    "Where the stem begins, in the scan's space; further places say what it passes. By default it is the thickest long "
    "way through the skeleton",
    {},
    false,
    true },
  { "roughness",
    "--roughness",
    Real,
    "N",
    "4",
    false,
    Group::Roots,
    "Leave out what stands out of a root by less than N times its roughness, the scatter of its surface; 0 keeps all",
    {},
    false,
    true },
  { "edits",
    "--edits",
    Input,
    "FILE",
    "",
    false,
    Group::Roots,
    "Edit and name single roots as annotations.csv or annotations.mrk.json of an earlier run says, edited by hand" },
  { "soil-depth",
    "--soil-depth",
    Real,
    "MM",
    "",
    false,
    Group::Roots,
    "Depth of the soil plane below the base of the stem; counts roots and whorls above and below it" },
  { "as-is",
    "--as-is",
    Flag,
    "",
    "",
    false,
    Group::Roots,
    "Do not clean the mask; by default it is mended, hollow roots and cavities are filled, and the largest piece is "
    "kept" },
  { "keep-loops",
    "--keep-loops",
    Flag,
    "",
    "",
    false,
    Group::Roots,
    "Do not cut the mask where roots touch; by default it is cut there, so that no loops are left, or --loops N" },
  { "kernel",
    "--kernel",
    Real,
    "VALUE",
    "",
    false,
    Group::Roots,
    "In a grey scan, cut no voxel with this value or more; by default bright voxels are cut last" },
  { "neighborhood",
    "--neighborhood",
    Real,
    "VALUE",
    "",
    false,
    Group::Roots,
    "In a grey scan, fill no voxel below this value; by default it is chosen from how pieces, loops and cavities "
    "change "
    "with the level" },
  { "no-pictures",
    "--no-pictures",
    Flag,
    "",
    "",
    false,
    Group::Roots,
    "Leave out roots.png and roots.html",
    {},
    false,
    true },
  { "prefix",
    "--prefix",
    Text,
    "TEXT",
    "",
    false,
    Group::Roots,
    "Begin the names of all files in OUTDIR with this",
    {},
    false,
    true },
  { "prune-branches",
    "--prune-branches",
    Text,
    "L|Nr",
    "0.5r",
    false,
    Group::Skeleton,
    "Remove terminal branches shorter than L: 5mm, 8vox, or 1.5r (times the radius at their base); 0 keeps all" },
});

constexpr auto kRootsRows = Joined(kRunRows,
                                   kScanArgument,
                                   kFolderOutput,
                                   kSeparateRows,
                                   kScanRows,
                                   kRootsOwn,
                                   kResolutionRows,
                                   kCavityRows,
                                   kTableRows,
                                   kTriangleRows,
                                   kForceRows,
                                   kBurnRows,
                                   kBorderRows,
                                   kEngineRows);

} // namespace table

namespace
{

constexpr std::string_view kFooter =
  R"(OUTDIR gets roots.rsml, roots.swc, roots.graphml, roots.csv (a row per root), levels.csv, plant.csv, profile.csv,
columns.json (what the columns mean), page.html (a summary), roots.html (3-D), roots.png, mask.nrrd, medial.vtp,
skeleton.vtp, changes.txt (cuts and fills), annotations.csv and annotations.mrk.json (for --edits), and report.json.
All of it is written, or nothing.

A grey scan without --threshold gets one halfway between background and roots, which is reported. Where roots
touch, those that go on straight and as thick are the same root; contacts that may be read otherwise are listed.
Guide: roots.md

Examples:
  voxelcore roots slices/ --spacing 0.5,0.5,0.5 --threshold 15:inf -o maize/
  voxelcore roots root.nii.gz --up z- -o root/
  voxelcore roots root.nii.gz --up z- --edits root/annotations.csv -o edited/
  voxelcore roots root.nrrd --close 5vox --stems auto --soil-depth 30 -o crown/)";

} // namespace

RootsOptions
RootsOptionsFrom(const ParameterValues & values)
{
  const ParameterReader reader(values, kRootsCommand);
  RootsOptions          options;
  options.scan = reader.Text("scan");
  ReadScanFields(reader, options);
  if (options.edits.splitComponents)
  {
    throw UsageError("--split-components: roots works on one piece");
  }
  options.asIs = reader.IsSet("as-is");
  options.kernel = reader.Real("kernel");
  options.neighbourhood = reader.Real("neighborhood");
  options.keepLoops = reader.IsSet("keep-loops");
  options.stage = BurningFrom(reader);
  options.stage.border = BorderFrom(reader);
  options.edits.openAtBorder = options.stage.border == BorderEnds::Closed;
  options.stage.lambda.text = "0";
  options.rules.up = ParseUp(reader.Text("up"));
  options.rules.stems = reader.Text("stems") == "auto" ? 0 : static_cast<int>(reader.Whole("stems", 1, 1000));
  if (reader.IsGiven("stem"))
  {
    options.rules.stem = reader.Parsed("stem", ParsePlaces);
  }
  if (!options.rules.stem.empty() && options.rules.stems != 1)
  {
    throw UsageError("--stem gives the only stem; leave out --stems");
  }
  options.rules.bulge = reader.Real("roughness").value_or(options.rules.bulge);
  options.annotations = reader.FileIfGiven("edits").value_or("");
  options.soilDepth = reader.Real("soil-depth");
  options.prefix = reader.Text("prefix");
  // It stands in links of the page, too.
  if (options.prefix.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-.") !=
        std::string::npos ||
      options.prefix.starts_with('.'))
  {
    throw UsageError("--prefix " + options.prefix +
                     ": expected letters, digits, '_', '-' and '.', and no '.' in front");
  }
  options.pictures = !reader.IsSet("no-pictures");
  options.htmlTriangles = static_cast<std::size_t>(reader.Whole("html-triangles", 1000, 20000000));
  options.output = reader.File("output");
  options.engine = EngineFrom(reader);
  options.threads = ThreadsFrom(values);
  options.force = reader.IsSet("force");
  return options;
}

namespace
{

std::vector<std::string>
CaseArguments(const CasePlace & place)
{
  return { "-o", place.folder.string() + "/", "--prefix", place.name + "_" };
}

CaseInput
Understand(const ParameterValues & values)
{
  return { RootsOptionsFrom(values).reading, {} };
}

constexpr AsCase kAsCase{
  .arguments = CaseArguments,
  .understand = Understand,
  .flag = "--roots",
  .description = "Run 'voxelcore roots' on each scan, with the options of that command; compare plants by their traits",
  .drawsUnlessTold = true,
  .hasBids = false,
};

Outcome
Run(const Invocation & call)
{
  RootsOptions options = RootsOptionsFrom(call.values);
  options.threads = call.threads;
  options.command = call.whole;
  const RootsResult result = RunRootsJob(options, call.context);
  call.Done(result.report);
  return { .warnings = result.warnings, .text = RootsText(result), .notes = result.notes };
}

} // namespace

constinit const Command kRootsCommand{ .name = "roots",
                                       .description = "Find the roots of a plant in a CT or MRI scan, and measure them",
                                       .footer = kFooter,
                                       .place = 30,
                                       .rows = table::kRootsRows,
                                       .run = Run,
                                       .asCase = &kAsCase };

} // namespace voxelcore
