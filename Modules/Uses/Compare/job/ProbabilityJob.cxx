#include "voxelcore/Compare/ProbabilityJob.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/LengthUnit.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/ParseReal.h"
#include "voxelcore/Base/Text.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Compare/CompareTables.h"
#include "voxelcore/Imaging/GreyVolume.h"
#include "voxelcore/Jobs/CoreJobSteps.h"
#include "voxelcore/Jobs/DisplayFiles.h"
#include "voxelcore/Jobs/JobTools.h"
#include "voxelcore/Jobs/LabelVolumes.h"
#include "voxelcore/Jobs/OutputNames.h"
#include "voxelcore/Jobs/SkeletonFiles.h"
#include "voxelcore/Models/TableColumns.h"
#include "voxelcore/Report/ReportTable.h"
#include "voxelcore/Shape/ShapeBits.h"
#include "voxelcore/Shape/ShapeOperations.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace voxelcore
{

namespace fs = std::filesystem;

namespace
{

constexpr std::size_t kMostThresholds = 100; ///< one percent each
constexpr double      kInfinity = std::numeric_limits<double>::infinity();

/** The map where it reaches the lowest threshold. */
struct ProbabilityMap
{
  InputScan  scan; ///< its only label is where that is
  GreyVolume values;
  double     scale = 1; ///< of a stored value
};

/** The least value that reaches a threshold. */
float
StoredValue(double threshold, double scale)
{
  return static_cast<float>(threshold * scale);
}

ReadOptions
ReadingAt(ReadOptions reading, double threshold, double scale)
{
  reading.threshold = { static_cast<double>(StoredValue(threshold, scale)), kInfinity };
  reading.refuseGrey = false;
  return reading;
}

ProbabilityMap
ReadMap(const ProbabilityOptions & options, const ProgressCallback & progress)
{
  const SkeletonOptions & making = options.making;
  ProbabilityMap          map;
  // Of whole numbers this is more than what reaches the lowest threshold.
  map.scan = ReadScanOrMesh(making.input,
                            ReadingAt(making.reading, options.thresholds.front(), 1),
                            making.resolution,
                            PartOfProgress(progress, 0, 0.5));
  const VoxelBox part = PartRead(map.scan);
  const VoxelBox box = map.scan.labels.at(0).shape.Box();
  double         least = kInfinity;
  double         greatest = 0;
  bool           areWhole = true;
  map.values.box = box;
  const auto take = [&](std::int32_t y, std::int32_t z, std::span<const float> row) {
    for (const float value : row)
    {
      least = std::min(least, static_cast<double>(value));
      greatest = std::max(greatest, static_cast<double>(value));
      areWhole = areWhole && value == std::floor(value);
    }
    if (y >= box.lower[1] && y < box.lower[1] + box.size[1] && z >= box.lower[2] && z < box.lower[2] + box.size[2])
    {
      const auto first = row.begin() + (box.lower[0] - part.lower[0]);
      map.values.values.insert(map.values.values.end(), first, first + box.size[0]);
    }
  };
  VisitGreyRows(making.input, part, making.reading, take, PartOfProgress(progress, 0.5, 1));
  map.scale = ProbabilityScale(least, greatest, areWhole, making.input.string());
  return map;
}

/** The voxels that reach a threshold. */
LabelShape
ShapeAt(const ProbabilityMap & map, double threshold)
{
  LabelShape       label = map.scan.labels.front();
  const VoxelBox & box = map.values.box;
  const float      least = StoredValue(threshold, map.scale);
  VoxelShape       shape(box);
  for (std::int32_t z = 0; z < box.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < box.size[1]; ++y)
    {
      const float * const values = map.values.Row(box.lower[0], box.lower[1] + y, box.lower[2] + z);
      const auto          row = shape.Row(y, z);
      for (std::int32_t x = 0; x < box.size[0]; ++x)
      {
        if (values[x] >= least)
        {
          row[static_cast<std::size_t>(x) >> 6U] |= std::uint64_t{ 1 } << (static_cast<unsigned>(x) & 63U);
        }
      }
    }
  }
  label.shape = CropToVoxels(std::move(shape));
  label.voxels = label.shape.CountVoxels();
  return label;
}

ScanAtHand
Edited(const ProbabilityMap & map, LabelShape shape, const SkeletonOptions & making)
{
  ScanAtHand scan;
  scan.volume = map.scan;
  scan.volume.labels.clear();
  std::vector<LabelShape> labels;
  labels.push_back(std::move(shape));
  scan.edited = EditLabels(std::move(labels), map.scan.geometry, making.edits, true, making.input.string());
  return scan;
}

CoreOptions
OptionsAt(const SkeletonOptions & making, double threshold, double scale)
{
  SkeletonOptions at = making;
  at.reading = ReadingAt(making.reading, threshold, scale);
  return CoreOptionsOf(at);
}

fs::path
TreePath(const fs::path & output, double threshold)
{
  return FileOutputPath(output, "_threshold-" + ShortText(threshold));
}

/** Removes the components that hold none of these places. Gives their number. */
std::size_t
KeepComponentsWith(const std::vector<std::array<std::int32_t, 3>> & voxels, LabelShape & label)
{
  std::size_t removed = 0;
  VoxelShape  kept(label.shape.Box());
  for (const VoxelShape & component : SplitComponents(label.shape))
  {
    if (ranges::any_of(voxels, [&](const auto & at) { return component.Contains(at[0], at[1], at[2]); }))
    {
      PutInto(component, kept);
    }
    else
    {
      ++removed;
    }
  }
  if (removed > 0)
  {
    label.shape = CropToVoxels(std::move(kept));
    label.voxels = label.shape.CountVoxels();
  }
  return removed;
}

/** A voxel that each stable branch passes through. */
std::vector<std::array<std::int32_t, 3>>
VoxelsOfStable(const SkeletonGraph & tree, const std::vector<std::uint8_t> & stable, const ImageGeometry & geometry)
{
  std::vector<std::array<std::int32_t, 3>> voxels;
  for (std::size_t branch = 0; branch < stable.size(); ++branch)
  {
    if (stable[branch] != 0)
    {
      const auto    points = tree.Branch(branch);
      const Vector3 place = PhysicalToLattice(geometry, tree.positions[points[points.size() / 2]]);
      auto &        voxel = voxels.emplace_back();
      for (std::size_t k = 0; k < 3; ++k)
      {
        voxel[k] = static_cast<std::int32_t>(std::floor(place[k]));
      }
    }
  }
  return voxels;
}

/** Takes off ends that are not stable, and measures what is left. */
void
KeepStable(LabelOutcome &             outcome,
           std::size_t                chosen,
           const TreesOfThresholds &  all,
           const ProbabilityOptions & options,
           std::size_t &              ends)
{
  SkeletonPart &        part = *outcome.skeleton;
  const SkeletonNumbers before = part.table.numbers;
  part.lives = LivesOf(part.graph, chosen, all);
  auto unstable = StableOnes(part.lives, options.persistence);
  for (std::uint8_t & flag : unstable)
  {
    flag = flag != 0 ? 0 : 1;
  }
  ends = PruneMarked(part.graph, unstable);
  if (ends > 0)
  {
    part.table = MeasureBranches(part.graph, { options.making.stage.branches.root });
    outcome.record.skeleton->numbers = part.table.numbers;
    part.lives = LivesOf(part.graph, chosen, all);
  }
  const SkeletonNumbers & now = part.table.numbers;
  if (now.components != before.components || now.cycles != before.cycles)
  {
    throw CertificateError(options.making.input.string() +
                           ": the tree without ends that are not stable has another topology; nothing was written");
  }
  RequireLives(part.graph, chosen, all, part.lives, options.making.input.string());
}

/** Before hours of work. */
void
CheckTargetsOf(const ProbabilityOptions & options, OutputTransaction & transaction)
{
  const SkeletonOptions & making = options.making;
  if (making.output.extension() != ".vtp")
  {
    throw UsageError(making.output.string() + ": with --probability a skeleton is written as .vtp");
  }
  CheckCoreTargets(CoreOptionsOf(making), transaction);
  const SkeletonFiles   files(making.output, making.input, making.targets, transaction);
  const DisplayFiles    shown(making.display, making.input, transaction);
  const fs::path        table = FileOutputPath(making.output, "_thresholds").replace_extension(".csv");
  std::vector<fs::path> targets{ making.output, table, ColumnsBeside(table) };
  for (const double threshold : options.thresholds)
  {
    targets.push_back(TreePath(making.output, threshold));
  }
  for (const auto & map : { making.targets.branchMap, making.targets.orderMap, making.targets.skeletonMap })
  {
    if (map)
    {
      targets.push_back(*map);
    }
  }
  CheckTargets(transaction, targets);
}

CompareTable
TableOf(const ProbabilityResult & result)
{
  const SpatialUnit unit = result.report.input.geometry.unit;
  CompareTable      table{ "thresholds", {}, {} };
  for (const Column & column : std::to_array<Column>({
         { "threshold", "", "probability from which voxels are taken" },
         { "voxels", "", "that reach it" },
         { "pieces", "", "of their shape and of its tree, after edits" },
         { "loops", "", "the same" },
         { "branches", "", "of the tree" },
         { "length", "mm", "of the tree" },
         { "stable_branches", "", "whose persistence is at least --persistence" },
         { "stable_length", "mm", "of these" },
         { "chosen", "", "1: the tree in OUT.vtp is of this threshold" },
       }))
  {
    table.columns.push_back({ column.name, InUnit(column.unit, unit), column.meaning });
  }
  for (const ThresholdRecord & record : result.thresholds)
  {
    const auto whole = [](auto number) { return static_cast<std::int64_t>(number); };
    table.rows.push_back({ record.threshold,
                           whole(record.voxels),
                           record.topology.betti[0],
                           record.topology.betti[1],
                           whole(record.branches),
                           record.length,
                           whole(record.stableBranches),
                           record.stableLength,
                           whole(record.isChosen ? 1 : 0) });
  }
  return table;
}

} // namespace

double
ProbabilityScale(double least, double greatest, bool areWhole, const std::string & where)
{
  if (!(least >= 0 && greatest <= 255) || (greatest > 1 && !areWhole))
  {
    throw InputError(where + ": holds values from " + ShortText(least, 4) + " to " + ShortText(greatest, 4) +
                     (least >= 0 && greatest <= 255 ? ", not all whole," : "") +
                     " which are no probabilities; give a map from 0 to 1, or whole numbers from 0 to 255");
  }
  return greatest > 1 ? 255 : 1;
}

std::vector<double>
ParseThresholds(std::string_view text)
{
  std::vector<double> thresholds;
  for (const std::string & one : SplitText(text, ','))
  {
    const auto value = ParseReal(one);
    if (!value || !(*value > 0 && *value <= 1) || ranges::count(thresholds, *value) > 0)
    {
      throw UsageError("--thresholds " + std::string(text) +
                       ": expected probabilities above 0 and up to 1, each once, such as 0.3,0.5,0.7");
    }
    thresholds.push_back(*value);
  }
  if (thresholds.size() < 2 || thresholds.size() > kMostThresholds)
  {
    throw UsageError("--thresholds " + std::string(text) + ": expected 2 to " + std::to_string(kMostThresholds) +
                     " values");
  }
  ranges::sort(thresholds);
  return thresholds;
}

ProbabilityResult
RunProbabilityJob(const ProbabilityOptions & asked, const JobContext & given)
{
  ProbabilityOptions      options = asked;
  const JobContext        context = ForwardOnly(given);
  const SkeletonOptions & making = options.making;
  ProbabilityResult       result;
  OutputTransaction       transaction(making.force, context.temporaries);
  NameInFolder(options.making, transaction);
  CheckTargetsOf(options, transaction);
  StagePlan            plan(context.progress, { 0.05, 0.75, 0.05, 0.15 });
  const ProbabilityMap map = ReadMap(options, plan.Next("reading"));

  TreesOfThresholds all{ options.thresholds, {} };
  JobContext        part = context;
  const auto        trees = plan.Next();
  const auto        share = [&](std::size_t done) {
    return static_cast<double>(done) / static_cast<double>(options.thresholds.size());
  };
  for (const double threshold : options.thresholds)
  {
    const std::size_t number = all.trees.size();
    ThresholdRecord & record = result.thresholds.emplace_back();
    record.threshold = threshold;
    LabelShape shape = ShapeAt(map, threshold);
    record.voxels = shape.voxels;
    SkeletonGraph & tree = all.trees.emplace_back();
    if (record.voxels == 0)
    {
      continue;
    }
    part.progress = NamedPartOfProgress(trees, "threshold " + ShortText(threshold), share(number), share(number + 1));
    ScanAtHand scan = Edited(map, std::move(shape), making);
    scan.done = [&](LabelOutcome & outcome) {
      record.topology = outcome.record.skeleton->topology;
      record.branches = outcome.skeleton->graph.BranchCount();
      record.length = outcome.skeleton->table.numbers.totalLength;
      tree = outcome.skeleton->graph;
    };
    SkeletonOptions alone = making;
    alone.output = TreePath(making.output, threshold);
    alone.targets = SkeletonTargets();
    alone.display = DisplayTargets();
    alone.report.reset();
    for (const char * option : { "probability", "thresholds", "persistence" })
    {
      alone.further.erase(option); // it is that of `voxelcore skeleton --threshold`, to the byte
    }
    StageCoreJob(OptionsAt(alone, threshold, map.scale), transaction, part, false, {}, &scan);
    part.admit = {}; // the first is the largest
  }

  const auto                             following = plan.Next("branches");
  std::vector<std::vector<BranchLife>>   lives;
  std::vector<std::vector<std::uint8_t>> stable;
  for (std::size_t i = 0; i < all.trees.size(); ++i)
  {
    lives.push_back(LivesOf(all.trees[i], i, all, PartOfProgress(following, share(i), share(i + 1))));
    RequireLives(all.trees[i], i, all, lives.back(), making.input.string());
    stable.push_back(StableOnes(lives.back(), options.persistence));
    for (std::size_t branch = 0; branch < stable.back().size(); ++branch)
    {
      result.thresholds[i].stableBranches += stable.back()[branch];
      result.thresholds[i].stableLength += stable.back()[branch] != 0 ? all.trees[i].BranchLength(branch) : 0;
    }
  }
  const std::size_t chosen = StablestThreshold(all, lives, options.persistence);
  const double      threshold = options.thresholds[chosen];
  result.thresholds[chosen].isChosen = true;

  part.progress = plan.Next();
  ScanAtHand        scan = Edited(map, ShapeAt(map, threshold), making);
  const std::size_t pieces = KeepComponentsWith(VoxelsOfStable(all.trees[chosen], stable[chosen], map.scan.geometry),
                                                scan.edited.labels.at(0).label);
  std::size_t       ends = 0;
  scan.done = [&](LabelOutcome & outcome) { KeepStable(outcome, chosen, all, options, ends); };
  CoreResult made = StageCoreJob(OptionsAt(making, threshold, map.scale), transaction, part, false, {}, &scan);
  result.report = std::move(made.report);
  result.warnings = std::move(made.warnings);
  result.notes = std::move(made.notes);
  if (map.scale != 1)
  {
    result.notes.push_back(making.input.string() + ": values from 0 to 255 are taken as probabilities from 0 to 1");
  }
  std::string leftOut = pieces > 0 ? Counted(pieces, "piece", "pieces") : "";
  if (ends > 0)
  {
    leftOut += (pieces > 0 ? " and " : "") + Counted(ends, "end", "ends");
  }
  result.notes.push_back(
    "threshold " + ShortText(threshold) + " is chosen" +
    (leftOut.empty() ? ""
                     : "; left out, as they live over less than " + ShortText(options.persistence) + ": " + leftOut));
  const CompareTable table = TableOf(result);
  const fs::path     path = FileOutputPath(making.output, "_thresholds").replace_extension(".csv");
  WriteCompareCsv(transaction.Stage(path), table, context.Heads(result.report.input.geometry.unit));
  WriteTextFile(transaction.Stage(ColumnsBeside(path)), CompareColumnsJson({ table }));
  Finish(transaction, context);
  return result;
}

std::string
ThresholdsText(const ProbabilityResult & result)
{
  double longest = 0;
  for (const ThresholdRecord & record : result.thresholds)
  {
    longest = std::max(longest, record.length);
  }
  const LengthUnit                      unit = LengthUnit::For(longest, result.report.input.geometry.unit);
  std::vector<std::vector<std::string>> rows{ { "threshold",
                                                "",
                                                "voxels",
                                                "pieces",
                                                "loops",
                                                "branches",
                                                "length " + unit.Name(),
                                                "stable branches",
                                                "stable length " + unit.Name() } };
  for (const ThresholdRecord & record : result.thresholds)
  {
    rows.push_back({ ShortText(record.threshold),
                     record.isChosen ? "chosen" : "",
                     std::to_string(record.voxels),
                     std::to_string(record.topology.betti[0]),
                     std::to_string(record.topology.betti[1]),
                     std::to_string(record.branches),
                     unit.Text(record.length),
                     std::to_string(record.stableBranches),
                     unit.Text(record.stableLength) });
  }
  return FormatTable(rows);
}

} // namespace voxelcore
