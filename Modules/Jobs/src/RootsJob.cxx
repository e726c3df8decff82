#include "voxelcore/RootsJob.h"

#include "CoreJobSteps.h"
#include "JobTools.h"
#include "RootsDisplay.h"
#include "voxelcore/Error.h"
#include "voxelcore/GreyScan.h"
#include "voxelcore/LengthUnit.h"
#include "voxelcore/OutputNames.h"
#include "voxelcore/ReadInput.h"
#include "voxelcore/ReportTable.h"
#include "voxelcore/ShapeTopology.h"
#include "voxelcore/Text.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <limits>
#include <utility>

namespace voxelcore
{

namespace fs = std::filesystem;

namespace
{

constexpr std::array<const char *, 6> kDirections{ "x+", "x-", "y+", "y-", "z+", "z-" };

/** What is written besides pictures. */
constexpr std::array<const char *, 11> kFiles{ "mask.nrrd",    "medial.vtp",  "skeleton.vtp", "roots.rsml",
                                               "roots.csv",    "levels.csv",  "plant.csv",    "profile.csv",
                                               "columns.json", "report.json", "page.html" };

CoreOptions
CoreOptionsOf(const RootsOptions & options)
{
  CoreOptions core;
  core.scan = options.scan;
  core.reading = options.reading;
  core.reading.refuseGrey = core.reading.labels == "all";
  core.resolution = options.resolution;
  core.edits = options.edits;
  if (!options.asIs)
  {
    CleanForRoots(core.edits);
  }
  core.further = options.further;
  CompletePruning(core.lambdas, core.tolerances);
  core.skeleton = options.stage;
  core.output = options.output / "medial.vtp";
  core.skeletonOutput = options.output / "skeleton.vtp";
  core.engine = options.engine;
  core.threads = options.threads;
  core.force = options.force;
  core.command = options.command;
  return core;
}

/** The width in voxels up to which holes are closed, of those tried that with the fewest pieces, loops and cavities
 *  left; the least of equals. */
GapWidth
BestWidth(const LabelMap & volume, const CoreOptions & core)
{
  // In voxels of the greatest spacing. Lumens must be wider than that to be found, holes narrower to be closed.
  const Vector3 & spacing = volume.geometry.spacing;
  const auto [least, most] = std::minmax({ spacing[0], spacing[1], spacing[2] });
  std::optional<GapWidth> best;
  std::int64_t            fewest = 0;
  for (const double holes : { 2.5, 4.0, 6.0 })
  {
    ShapeEditOptions edits = core.edits;
    edits.simplify.reset(); // it would cut the loops by which widths are compared
    edits.fillHollows = ParseGapWidth(RoundTripText(std::round(10 * holes * most / least) / 10) + "vox");
    const EditedLabels edited =
      EditLabels(volume.labels, volume.geometry, edits, core.reading.labels != "all", core.scan.string());
    std::int64_t left = 0;
    for (const EditedLabel & one : edited.labels)
    {
      const auto betti = ComputeShapeTopology(one.label.shape).betti;
      left += betti[0] - 1 + betti[1] + betti[2];
    }
    if (!best || left < fewest)
    {
      best = edits.fillHollows;
      fewest = left;
    }
    if (fewest == 0)
    {
      break;
    }
  }
  return *best;
}

/** Chooses the threshold of grey values that come without one, and how hollows are filled. */
void
LookAtScan(CoreOptions & core, bool asIs, std::vector<std::string> & notes)
{
  const bool choosesWidth = !asIs && !core.edits.close && !core.edits.fillHollows && !core.edits.fillSlices;
  if (!choosesWidth && !core.reading.refuseGrey)
  {
    return;
  }
  LabelMap volume;
  try
  {
    volume = ReadScanOrMesh(core.scan, core.reading, core.resolution);
  }
  catch (const GreyScanError & error)
  {
    core.reading.threshold = std::pair(error.grey.half, std::numeric_limits<double>::infinity());
    core.reading.refuseGrey = false;
    notes.push_back(
      core.scan.string() + ": " + GreyScanText(error.grey) + "; threshold " + RoundTripText(error.grey.half) +
      ":inf, halfway between background and roots (Otsu: " + OtsuRange(error.grey) + "); for another give --threshold");
    if (choosesWidth)
    {
      volume = ReadScanOrMesh(core.scan, core.reading, core.resolution);
    }
  }
  if (choosesWidth)
  {
    core.edits.fillHollows = BestWidth(volume, core);
    notes.push_back("hollows are filled where they open through holes up to " + core.edits.fillHollows->text +
                    " wide; for another width give --fill-hollows");
  }
}

/** yyyy-mm-ddThh:mm:ss, UTC: when a file was changed last. */
std::string
ModificationTime(const fs::path & path)
{
  std::error_code error;
  const auto      time = fs::last_write_time(path, error);
  const auto      seconds =
    error ? std::time_t{ 0 }
               : std::chrono::system_clock::to_time_t(
              std::chrono::time_point_cast<std::chrono::system_clock::duration>(std::chrono::file_clock::to_sys(time)));
  std::tm parts{};
  gmtime_r(&seconds, &parts);
  char text[32];
  std::strftime(text, sizeof(text), "%Y-%m-%dT%H:%M:%S", &parts);
  return text;
}

std::string
JsonNumber(double value)
{
  char text[40];
  std::snprintf(text, sizeof(text), "%.9g", value);
  return std::isfinite(value) ? text : "null";
}

/** The part of the report that is about roots; goes before the last brace of the core's. */
std::string
RootsJson(const RootModel & model)
{
  const RootTraits & traits = model.traits;
  std::string        json = ",\n  \"roots\": {\n    \"up\": \"" + UpText(model.roots.up) +
                     "\",\n    \"up_found\": " + (model.roots.upFound ? "true" : "false") +
                     ",\n    \"axes\": " + std::to_string(model.roots.axes.size()) +
                     ",\n    \"stems\": " + std::to_string(traits.stems) + ",\n    \"total_length\": " +
                     JsonNumber(traits.levels.empty() ? 0 : traits.levels.back().totalLength) +
                     ",\n    \"whorls\": " + std::to_string(traits.whorls) + ",\n    \"contacts\": [";
  for (std::size_t i = 0; i < model.roots.meetings.size(); ++i)
  {
    const RootMeeting & meeting = model.roots.meetings[i];
    json += std::string(i > 0 ? "," : "") + "\n      { \"place\": [" + JsonNumber(meeting.position[0]) + ", " +
            JsonNumber(meeting.position[1]) + ", " + JsonNumber(meeting.position[2]) +
            "], \"radius\": " + JsonNumber(meeting.radius) + ", \"margin\": " + JsonNumber(meeting.margin) +
            ", \"undecided\": " + (meeting.undecided ? "true" : "false") + " }";
  }
  return json + (model.roots.meetings.empty() ? "]" : "\n    ]") + "\n  }\n}\n";
}

/** What a user should look at. */
void
AddRemarks(RootsResult & result)
{
  const RootModel & model = result.model;
  if (model.roots.upFound)
  {
    result.notes.push_back("up is " + UpText(model.roots.up) +
                           ", found by the stem; if the plant stands otherwise, give --up");
  }
  const LabelRecord & label = result.report.labels.front();
  if (label.edits && label.edits->voxelsRemoved * 200 > label.voxels)
  {
    result.warnings.push_back(std::to_string(label.edits->componentsRemoved) + " pieces with " +
                              std::to_string(label.edits->voxelsRemoved) +
                              " voxels are left out; if broken roots are among them, join them with --close D, or keep "
                              "them as loose pieces with --min-voxels N");
  }
  const LengthUnit      unit = LengthUnit::For(model.traits.depth, model.unit);
  constexpr std::size_t listed = 10;
  std::size_t           undecided = 0;
  for (const RootMeeting & meeting : model.roots.meetings)
  {
    undecided += meeting.undecided ? 1 : 0;
    if (meeting.undecided && undecided <= listed)
    {
      result.notes.push_back("undecided contact at " + unit.Text(meeting.position[0]) + ", " +
                             unit.Text(meeting.position[1]) + ", " + unit.Text(meeting.position[2]) + " " +
                             unit.Name() + ": another pairing of the roots is nearly as good");
    }
  }
  if (undecided > listed)
  {
    result.notes.push_back(std::to_string(undecided - listed) + " more undecided contacts stand in report.json");
  }
  const auto loose = std::count_if(model.roots.axes.begin(), model.roots.axes.end(), [](const RootAxis & axis) {
    return axis.loose && axis.level == 0;
  });
  if (loose > 0)
  {
    result.notes.push_back(std::to_string(loose) + (loose == 1 ? " piece hangs" : " pieces hang") +
                           " together with no stem; marked as loose");
  }
}

fs::path
StagedName(const OutputTransaction & transaction, const fs::path & target)
{
  for (const OutputTransaction::StagedFile & file : transaction.StagedFiles())
  {
    if (file.target == target)
    {
      return file.temporary;
    }
  }
  throw std::logic_error(target.string() + " is not staged");
}

} // namespace

std::optional<Vector3>
ParseUp(const std::string & text)
{
  if (text == "auto")
  {
    return std::nullopt;
  }
  const auto found = std::find(kDirections.begin(), kDirections.end(), text);
  if (found == kDirections.end())
  {
    throw UsageError("--up " + text + ": expected auto, x+, x-, y+, y-, z+ or z-");
  }
  const auto number = static_cast<std::size_t>(found - kDirections.begin());
  Vector3    up{};
  up[number / 2] = number % 2 == 0 ? 1 : -1;
  return up;
}

std::string
UpText(const Vector3 & up)
{
  std::size_t axis = 0;
  for (const std::size_t other : { std::size_t{ 1 }, std::size_t{ 2 } })
  {
    axis = std::abs(up[other]) > std::abs(up[axis]) ? other : axis;
  }
  return kDirections[2 * axis + (up[axis] < 0 ? 1 : 0)];
}

void
CleanForRoots(ShapeEditOptions & edits)
{
  edits.mend = true;
  edits.fillCavities = true;
  if (!edits.largest && !edits.minVoxels)
  {
    edits.largest = 1;
  }
}

RootsResult
RunRootsJob(const RootsOptions & options, const JobContext & given)
{
  const JobContext  context = ForwardOnly(given);
  Stopwatch         total;
  OutputTransaction transaction(options.force, context.temporaries);
  const fs::path &  folder = options.output;
  transaction.MakeDirectory(folder);
  for (const char * file : kFiles)
  {
    transaction.CheckTarget(folder / file);
  }
  const bool draws = options.pictures && DrawsRoots();
  if (draws)
  {
    transaction.CheckTarget(folder / "roots.png");
    transaction.CheckTarget(folder / "roots.html");
  }
  CoreOptions core = CoreOptionsOf(options);
  CheckCoreTargets(core, transaction);

  RootsResult result;
  ReportProgress(context.progress, "looking", 0);
  LookAtScan(core, options.asIs, result.notes);
  LabelShape    mask;
  ImageGeometry geometry;
  JobContext    part = context;
  part.progress = PartOfProgress(context.progress, 0, draws ? 0.75 : 0.95);
  CoreResult staged =
    StageCoreJob(core,
                 transaction,
                 part,
                 false,
                 [&](const std::vector<EditedLabel> & labels, const ImageGeometry & where) {
                   if (labels.size() != 1)
                   {
                     throw UsageError(options.scan.string() + ": " + std::to_string(labels.size()) +
                                      " labels; choose one with --labels, or take all as one with --binary");
                   }
                   mask = labels.front().label;
                   geometry = where;
                 });
  result.report = std::move(staged.report);
  result.warnings = std::move(staged.warnings);
  result.notes.insert(result.notes.end(), staged.notes.begin(), staged.notes.end());

  SkeletonModel skeleton = ReadSkeletonVtp(StagedName(transaction, core.skeletonOutput));
  result.model.name = ScanName(options.scan);
  result.model.unit = result.report.input.geometry.unit;
  result.model.graph = std::move(skeleton.parts.at(0).graph);
  result.model.roots = FindRoots(result.model.graph, options.rules);
  result.model.traits = MeasureRoots(result.model.graph, result.model.roots, options.soilDepth);
  AddRemarks(result);

  ReportProgress(context.progress, "writing", draws ? 0.75 : 0.95);
  const double volume = result.report.labels.front().volumeMm3;
  WriteLabelVolume(transaction.StageWithCompanions(folder / "mask.nrrd"), geometry, { mask });
  WriteRsml(transaction.Stage(folder / "roots.rsml"),
            result.model,
            { ModificationTime(options.scan), "VoxelCore " + VoxelCoreVersion(), result.report.input.sha256 });
  WriteRootCsv(transaction.Stage(folder / "roots.csv"), result.model);
  WriteRootLevelCsv(transaction.Stage(folder / "levels.csv"), result.model);
  WritePlantCsv(transaction.Stage(folder / "plant.csv"), result.model, volume);
  WriteRootProfileCsv(transaction.Stage(folder / "profile.csv"), result.model);
  WriteTextFile(transaction.Stage(folder / "columns.json"), RootColumnsJson(result.model.unit));
  if (draws)
  {
    DrawRoots(result.model,
              mask.shape,
              geometry,
              options.htmlTriangles,
              folder,
              transaction,
              PartOfProgress(context.progress, 0.8, 1));
  }
  std::vector<std::string> remarks = result.warnings;
  remarks.insert(remarks.end(), result.notes.begin(), result.notes.end());
  WriteTextFile(transaction.Stage(folder / "page.html"), RootsPage(result.model, volume, remarks, draws));
  result.report.seconds.total = total.Lap();
  result.report.peakMemoryMb = PeakMemoryMb();
  std::string json = ReportJson(result.report);
  json.replace(json.rfind("\n}"), std::string::npos, RootsJson(result.model));
  WriteTextFile(transaction.Stage(folder / "report.json"), json);
  Finish(transaction, context);
  return result;
}

std::string
RootsText(const RootsResult & result)
{
  const RootTraits & traits = result.model.traits;
  const LengthUnit   unit = LengthUnit::For(traits.depth, result.model.unit);
  const auto         angle = [](double value) {
    char text[24];
    std::snprintf(text, sizeof(text), "%.0f", value);
    return std::isfinite(value) ? std::string(text) : std::string("-");
  };
  std::vector<std::vector<std::string>> rows{ { "level",
                                                "roots",
                                                "length " + unit.Name(),
                                                "mean " + unit.Name(),
                                                "diameter " + unit.Name(),
                                                "emergence deg",
                                                "from down deg" } };
  for (const RootLevelRecord & level : traits.levels)
  {
    using Kind = RootLevelRecord::Kind;
    rows.push_back({ level.kind == Kind::All        ? std::string("all")
                     : level.kind == Kind::Laterals ? std::string("laterals")
                                                    : std::to_string(level.level),
                     std::to_string(level.count),
                     unit.Text(level.totalLength),
                     level.count > 0 ? unit.Text(level.meanLength) : "-",
                     level.count > 0 ? unit.Text(level.meanDiameter) : "-",
                     angle(level.meanEmergenceAngle),
                     angle(level.meanTipFromDown) });
  }
  return FormatTable(rows) + std::to_string(traits.contacts) + (traits.contacts == 1 ? " contact" : " contacts") +
         " of roots, " + std::to_string(traits.undecidedContacts) + " undecided; " + std::to_string(traits.whorls) +
         (traits.whorls == 1 ? " whorl" : " whorls") + "; depth " + unit.Text(traits.depth) + " " + unit.Name() +
         ", width " + unit.Text(traits.width) + " " + unit.Name() + "\n";
}

} // namespace voxelcore
