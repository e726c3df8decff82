#include "voxelcore/Roots/RootsJob.h"

#include "voxelcore/Base/Library.h"
#include "voxelcore/Jobs/CoreJobSteps.h"
#include "voxelcore/Jobs/JobTools.h"
#include "RootsApart.h"
#include "RootsDisplay.h"
#include "RootsReport.h"
#include "RootsScan.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/LengthUnit.h"
#include "voxelcore/Base/SystemCalls.h"
#include "voxelcore/Base/Text.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Jobs/OutputNames.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace voxelcore
{

namespace fs = std::filesystem;

namespace
{

constexpr double       kTellLeftOut = 0.01; // of the skeleton's length
constexpr std::int32_t kUsualLevels = 5;

constexpr std::array<const char *, 6> kDirections{ "x+", "x-", "y+", "y-", "z+", "z-" };

/** What is written besides pictures. */
constexpr std::array<const char *, 16> kFiles{ "annotations.csv", "annotations.mrk.json",
                                               "mask.nrrd",       "medial.vtp",
                                               "skeleton.vtp",    "roots.rsml",
                                               "roots.csv",       "levels.csv",
                                               "plant.csv",       "profile.csv",
                                               "columns.json",    "changes.txt",
                                               "report.json",     "page.html",
                                               "roots.swc",       "roots.graphml" };

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
    if (options.rules.tornGap > 0)
    {
      core.edits.joinTorn = options.rules.tornGap;
    }
  }
  core.further = options.further;
  CompletePruning(core.lambdas, core.tolerances);
  core.skeleton = options.stage;
  core.output = options.Place("medial.vtp");
  core.skeletonOutput = options.Place("skeleton.vtp");
  core.engine = options.engine;
  core.threads = options.threads;
  core.force = options.force;
  core.command = options.command;
  return core;
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
  if (model.roots.bulges.count > 0)
  {
    result.notes.push_back(Counted(static_cast<std::int64_t>(model.roots.bulges.count), "bulge", "bulges") +
                           " left out: the surface of their root is as rough as they are high; to keep them, give "
                           "--roughness 0");
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

/** What the stem and the levels look like: a wrong stem makes all of them wrong. */
void
JudgeHierarchy(RootsResult & result)
{
  const RootTraits &  traits = result.model.traits;
  const LengthUnit    unit = LengthUnit::For(traits.depth, result.model.unit);
  const RootBalance & balance = traits.balance;
  if (std::abs(balance.Missing()) > 1e-9 * balance.skeleton)
  {
    throw CertificateError(unit.Text(balance.Missing()) + " " + unit.Name() + " of the skeleton's " +
                           unit.Text(balance.skeleton) + " belong to no root, and nothing says why");
  }
  if (balance.LeftOut() > kTellLeftOut * balance.skeleton)
  {
    result.warnings.push_back(unit.Text(balance.LeftOut()) + " " + unit.Name() + " of the skeleton's " +
                              unit.Text(balance.skeleton) + " belong to no root: " + unit.Text(balance.bridges) +
                              " are bridges between roots that touch, " + unit.Text(balance.removed) +
                              " were removed by edits, " + unit.Text(balance.bulges) + " stand out of rough roots");
  }
  double lateral = 0;
  for (std::size_t axis = 0; axis < traits.roots.size(); ++axis)
  {
    // What is shorter than the stem is thick is no more than a bulge of it.
    const RootRecord & root = traits.roots[axis];
    const bool         counts = result.model.roots.axes[axis].level == 1 && root.length > traits.stemDiameter;
    lateral = std::max(lateral, counts ? root.meanDiameter : 0.0);
  }
  const std::string other = "; if it is not the stem, give a place on it with --stem X,Y,Z";
  if (traits.stems == 1 && traits.stemLength < 2 * traits.stemDiameter)
  {
    result.warnings.push_back("the stem is shorter than twice its diameter" + other);
  }
  if (traits.stems == 1 && traits.stemDiameter < lateral)
  {
    result.warnings.push_back("the stem is thinner than one of its laterals" + other);
  }
  std::int32_t deepest = 0;
  for (const RootAxis & axis : result.model.roots.axes)
  {
    deepest = std::max(deepest, axis.level);
  }
  if (deepest > kUsualLevels)
  {
    result.notes.push_back("roots have levels up to " + std::to_string(deepest) + ", where plants have up to " +
                           std::to_string(kUsualLevels) +
                           "; look where roots touch, or along the stem, and correct them with --edits");
  }
}

/** Where roots touched before they were cut apart. */
void
RecallContacts(const RootsTopology & topology, RootModel & model)
{
  for (const RootMeeting & meeting : topology.roots.meetings)
  {
    for (RootAxis & axis : model.roots.axes)
    {
      axis.undecided =
        axis.undecided || (meeting.undecided && ranges::any_of(axis.points, [&](ElementIndex point) {
                             return Distance(model.graph.positions[point], meeting.position) <= meeting.reach;
                           }));
    }
    model.roots.meetings.push_back(meeting);
    model.roots.meetings.back().pairs.clear(); // branches of a skeleton that is no more
    model.roots.meetings.back().arms.clear();
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

RootsResult
RunRootsJob(const RootsOptions & options, const JobContext & given)
{
  const JobContext  context = ForwardOnly(given);
  Stopwatch         total;
  OutputTransaction transaction(options.force, context.temporaries);
  transaction.MakeDirectory(options.output);
  for (const char * file : kFiles)
  {
    transaction.CheckTarget(options.Place(file));
  }
  const bool draws = options.pictures && DrawsRoots();
  if (draws)
  {
    transaction.CheckTarget(options.Place("roots.png"));
    transaction.CheckTarget(options.Place("roots.html"));
  }
  CoreOptions core = CoreOptionsOf(options);
  CheckCoreTargets(core, transaction);

  RootsResult result;
  RootEditing editing(options.annotations, options.rules);
  ReportProgress(context.progress, "looking", 0);
  // Loops of touching roots are cut where the roots say so, not as an edit that knows no roots.
  const bool            cuts = !options.asIs && !options.keepLoops && !core.edits.change;
  const GapWidth        depth = core.edits.simplify.value_or(ParseGapWidth("2vox"));
  const TopologyRequest request = core.edits.topology;
  if (cuts)
  {
    core.edits.simplify.reset();
    core.edits.topology = {};
  }
  auto [scan, plain] = LookAtScan(core, options.asIs, result.notes);
  if (scan.edited.labels.size() != 1)
  {
    throw UsageError(options.scan.string() + ": " + std::to_string(scan.edited.labels.size()) +
                     " labels; choose one with --labels, or take all as one with --binary");
  }
  RootRules rules = options.rules;
  rules.tornSlack = ranges::max(scan.volume.geometry.spacing);
  if (cuts)
  {
    result.topology = TellRootsApart(scan.edited.labels.front().label,
                                     scan.volume.geometry,
                                     core,
                                     rules,
                                     { depth, request, options.kernel, options.neighbourhood, BorderOf(scan.volume) },
                                     editing,
                                     PartOfProgress(context.progress, 0, 0.35));
  }
  if (result.topology)
  {
    core.edits.change = result.topology->changes;
    EditedLabel & label = scan.edited.labels.front();
    label.edits = label.edits.value_or(EditRecord());
    label.edits->changed = { result.topology->voxelsAdded, result.topology->voxelsRemoved };
    (result.topology->asAsked ? result.notes : result.warnings).push_back(RootsTopologyText(*result.topology));
  }
  if (plain)
  {
    // So that who reads the scan by what is recorded gets the same mask.
    core.edits.change = ChangesBetween(*plain, scan.edited.labels.front().label.shape);
    plain.reset();
  }
  LabelShape    mask;
  ImageGeometry geometry;
  JobContext    part = context;
  part.progress = PartOfProgress(context.progress, 0.35, draws ? 0.75 : 0.95);
  CoreResult staged = StageCoreJob(
    core,
    transaction,
    part,
    false,
    [&](const std::vector<EditedLabel> & labels, const ImageGeometry & where) {
      mask = labels.front().label;
      geometry = where;
    },
    &scan);
  result.report = std::move(staged.report);
  result.warnings.insert(result.warnings.end(), staged.warnings.begin(), staged.warnings.end());
  result.notes.insert(result.notes.end(), staged.notes.begin(), staged.notes.end());

  result.model.name = ScanName(options.scan);
  result.model.unit = result.report.input.geometry.unit;
  std::vector<double> torn;
  if (result.topology && result.topology->before.betti[0] == 1)
  {
    // Two roots that cross cannot both be whole in a tree of voxels: they are followed where they still touched.
    result.model.graph = result.topology->graph;
    result.model.roots = result.topology->roots;
    torn = result.topology->torn;
  }
  else
  {
    SkeletonModel skeleton = ReadSkeletonVtp(StagedName(transaction, core.skeletonOutput));
    result.model.graph = std::move(skeleton.parts.at(0).graph);
    result.model.roots = FindRootsByGrey(mask.shape, geometry, core, rules, depth, editing, result.model.graph, torn);
    if (result.topology)
    {
      RecallContacts(*result.topology, result.model);
    }
  }
  WidenToBalls(result.model.graph);
  result.model.traits = MeasureRoots(result.model.graph, result.model.roots, options.soilDepth);
  if (!torn.empty())
  {
    const LengthUnit unit = LengthUnit::For(result.model.traits.depth, result.model.unit);
    result.notes.push_back(Counted(torn.size(), "gap", "gaps") + " of up to " + unit.Text(ranges::max(torn)) + " " +
                           unit.Name() +
                           " bridged, where two ends of a torn root face each other; the mask has them still");
  }
  result.warnings.insert(result.warnings.end(), editing.misfits.begin(), editing.misfits.end());
  if (!editing.edits.empty())
  {
    result.notes.push_back(Counted(editing.edits.size(), "root", "roots") + " edited or named as " +
                           options.annotations.string() + " says");
  }
  JudgeHierarchy(result);
  AddRemarks(result);

  ReportProgress(context.progress, "writing", draws ? 0.75 : 0.95);
  const double volume = result.report.labels.front().volumeMm3;
  WriteLabelVolume(transaction.StageWithCompanions(options.Place("mask.nrrd")), geometry, { mask });
  WriteRsml(transaction.Stage(options.Place("roots.rsml")),
            result.model,
            { ModificationTime(options.scan), "VoxelCore " + VoxelCoreVersion(), result.report.input.sha256 });
  WriteRootSwc(transaction.Stage(options.Place("roots.swc")), result.model);
  WriteRootGraphMl(transaction.Stage(options.Place("roots.graphml")), result.model);
  const HeadUnits units = context.Heads(result.model.unit);
  WriteRootCsv(transaction.Stage(options.Place("roots.csv")), result.model, units);
  WriteRootLevelCsv(transaction.Stage(options.Place("levels.csv")), result.model, units);
  WritePlantCsv(transaction.Stage(options.Place("plant.csv")), result.model, volume, units);
  WriteRootProfileCsv(transaction.Stage(options.Place("profile.csv")), result.model, units);
  WriteTextFile(transaction.Stage(options.Place("columns.json")), RootColumnsJson(result.model.unit));
  WriteTextFile(transaction.Stage(options.Place("changes.txt")), RootChangesText(result.topology, result.model.unit));
  WriteRootAnnotations(transaction.Stage(options.Place("annotations.csv")),
                       transaction.Stage(options.Place("annotations.mrk.json")),
                       result.model.graph,
                       editing,
                       result.model.unit,
                       units);
  if (draws)
  {
    DrawRoots(result.model, mask.shape, geometry, options, transaction, PartOfProgress(context.progress, 0.8, 1));
  }
  std::vector<std::string> remarks = result.warnings;
  remarks.insert(remarks.end(), result.notes.begin(), result.notes.end());
  WriteTextFile(transaction.Stage(options.Place("page.html")),
                RootsPage(result, volume, remarks, draws ? std::optional(options.prefix) : std::nullopt));
  result.report.seconds.total = total.Lap();
  result.report.peakMemoryMb = PeakMemoryMb();
  const std::string edits = RootEditsJson(editing.edits);
  WriteTextFile(
    transaction.Stage(options.Place("report.json")),
    ReportJson(result.report, ReportMember{ "roots", RootsJson(result.model, result.topology, volume, edits) }));
  Finish(transaction, context);
  return result;
}

} // namespace voxelcore
