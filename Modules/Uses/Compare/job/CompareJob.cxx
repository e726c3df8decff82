#include "voxelcore/Compare/CompareJob.h"

#include "TablesJson.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/ParseReal.h"
#include "voxelcore/Base/Text.h"
#include "voxelcore/Jobs/CoreJobSteps.h"
#include "voxelcore/Jobs/DisplayFiles.h"
#include "voxelcore/Jobs/JobTools.h"
#include "voxelcore/Jobs/LabelVolumes.h"
#include "voxelcore/Jobs/OutputNames.h"
#include "voxelcore/Labels/CropRange.h"
#include "voxelcore/Lattice/GridOffset.h"
#include "voxelcore/Models/AppendedVtp.h"
#include "voxelcore/Models/TreeFiles.h"
#include "voxelcore/Report/Sha256.h"
#include "voxelcore/Shape/BodyFrame.h"
#include "voxelcore/Shape/ShapeOperations.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <type_traits>
#include <utility>

namespace voxelcore
{

namespace fs = std::filesystem;

namespace
{

using Json = nlohmann::ordered_json;

/** How many voxels of A's grid B's first one lies from A's.
 *  \throws InputError unless voxels of both are at the same places, wherever both have any */
std::array<std::int32_t, 3>
OffsetOf(const CompareSide & a, const CompareSide & b)
{
  const ImageGeometry & gridA = std::get<LabelMap>(a.content).geometry;
  const ImageGeometry & gridB = std::get<LabelMap>(b.content).geometry;
  const auto            offset = GridOffset(gridA, gridB, kSamePlace);
  if (!offset || gridA.unit != gridB.unit)
  {
    throw InputError(b.name + ": does not have the grid of " + a.name +
                     " (spacing, directions, or places of voxels); resample one of them to the other's");
  }
  return *offset;
}

/** Puts B into A's grid, and takes of both what lies in the boxes of both. */
void
BringTogether(CompareSide & a, CompareSide & b, std::vector<std::string> & notes)
{
  const auto offset = OffsetOf(a, b);
  auto &     mapA = std::get<LabelMap>(a.content);
  auto &     mapB = std::get<LabelMap>(b.content);
  VoxelBox   common;
  CropRange  range;
  bool       isWhole = true;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const std::int64_t low = std::max(0, offset[k]);
    const std::int64_t high = std::min(mapA.geometry.size[k], offset[k] + mapB.geometry.size[k]);
    if (high <= low)
    {
      throw InputError(b.name + ": lies beside " + a.name + "; no voxel is in both");
    }
    common.lower[k] = static_cast<std::int32_t>(low);
    common.size[k] = static_cast<std::int32_t>(high - low);
    range.first[k] = common.lower[k];
    range.end[k] = static_cast<std::int32_t>(high);
    isWhole = isWhole && low == 0 && high == mapA.geometry.size[k] && mapA.geometry.size[k] == mapB.geometry.size[k];
  }
  if (isWhole)
  {
    return;
  }
  for (LabelShape & label : mapA.labels)
  {
    label.shape = VoxelsWithin(label.shape, common);
  }
  for (LabelShape & label : mapB.labels)
  {
    auto lower = label.shape.Box().lower;
    for (std::size_t k = 0; k < 3; ++k)
    {
      lower[k] += offset[k];
    }
    label.shape = VoxelsWithin(MovedTo(lower, label.shape), common);
  }
  notes.push_back("the grids differ in their boxes; what both hold is compared, voxels " + CropText(range) + " of " +
                  a.name);
}

/** A label of both; none where one has not. */
struct Pair
{
  ComparedLabel              label;
  std::optional<std::size_t> a;
  std::optional<std::size_t> b;
};

/** Those of one key are a pair, or the only one of each. */
template <typename TItems, typename TKey>
std::vector<Pair>
Paired(const TItems & a, const TItems & b, const TKey & keyOf, std::vector<std::string> & notes)
{
  std::map<decltype(keyOf(a[0])), Pair> pairs;
  if (a.size() == 1 && b.size() == 1)
  {
    if (keyOf(a[0]) != keyOf(b[0]))
    {
      notes.push_back("each has one label: these are compared, though their values differ");
    }
    return { { {}, 0, 0 } };
  }
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    pairs[keyOf(a[i])].a = i;
  }
  for (std::size_t i = 0; i < b.size(); ++i)
  {
    pairs[keyOf(b[i])].b = i;
  }
  std::vector<Pair> list;
  for (auto & [key, pair] : pairs)
  {
    list.push_back(pair);
  }
  return list;
}

ComparedMasks
CompareLabel(const LabelShape &       a,
             const LabelShape &       b,
             const ImageGeometry &    geometry,
             const CompareOptions &   options,
             const ProgressCallback & progress)
{
  ComparedMasks compared;
  compared.overlap = CountOverlap(a.shape, b.shape);
  compared.surface = MeasureSurfaceDistances(a.shape, b.shape, geometry.spacing);
  compared.open = CompareTopology6(a.shape, b.shape);
  compared.closed = CompareTopology26(a.shape, b.shape);
  compared.parts = FindDifferingParts(a.shape, b.shape);
  if (options.lines)
  {
    compared.lines.emplace();
    const auto parts =
      SkeletonsOfMasks({ a, b }, geometry, options.making, "A and B", PartOfProgress(progress, "skeletons", 0.1, 0.9));
    for (const bool ofA : { true, false })
    {
      const LabelShape &   own = ofA ? a : b;
      const LabelShape &   other = ofA ? b : a;
      const SkeletonPart & part = parts[ofA ? 0 : 1];
      compared.lines->push_back(MeasureCentreline(part.graph, geometry, own.shape, other.shape));
      const auto loops =
        FindLeavingLoops(part.graph, geometry, other.shape, ofA ? PartChange::Missed : PartChange::Invented);
      compared.parts.insert(compared.parts.end(), loops.begin(), loops.end());
    }
  }
  return compared;
}

void
CompareMasks(CompareSide              a,
             CompareSide              b,
             const CompareOptions &   options,
             CompareResult &          result,
             const ProgressCallback & progress)
{
  if (options.near)
  {
    throw UsageError("--near is for skeletons and medial surfaces, as masks are compared voxel by voxel; leave it out");
  }
  BringTogether(a, b, result.notes);
  const auto &               mapA = std::get<LabelMap>(a.content);
  const auto &               mapB = std::get<LabelMap>(b.content);
  std::vector<ComparedMasks> labels;
  const auto                 pairs = Paired(
    mapA.labels,
    mapB.labels,
    [](const LabelShape & label) { return label.value; },
    result.notes);
  if (pairs.empty())
  {
    throw InputError("neither " + a.name + " nor " + b.name + " has such a label: --labels " +
                     options.making.reading.labels);
  }
  for (std::size_t i = 0; i < pairs.size(); ++i)
  {
    const LabelShape   nothing;
    const LabelShape & labelA = pairs[i].a ? mapA.labels[*pairs[i].a] : nothing;
    const LabelShape & labelB = pairs[i].b ? mapB.labels[*pairs[i].b] : nothing;
    const auto share = [&](std::size_t done) { return static_cast<double>(done) / static_cast<double>(pairs.size()); };
    labels.push_back(
      CompareLabel(labelA, labelB, mapA.geometry, options, PartOfProgress(progress, share(i), share(i + 1))));
    labels.back().label = pairs[i].a ? labelA.value : labelB.value;
    labels.back().name = pairs[i].a ? labelA.name : labelB.name;
  }
  result.unit = mapA.geometry.unit;
  result.tables = TablesOf(labels, mapA.geometry);
}

double
NearOf(const CompareOptions & options, SpatialUnit unit)
{
  return options.near ? PlainLength(*options.near, unit, "--near") : 0;
}

SkeletonModel
TreesOf(CompareSide side, const CompareOptions & options, const ProgressCallback & progress)
{
  if (auto * const model = std::get_if<SkeletonModel>(&side.content))
  {
    return std::move(*model);
  }
  auto * const map = std::get_if<LabelMap>(&side.content);
  if (map == nullptr)
  {
    throw UsageError(side.name +
                     ": is a medial surface, which is compared with another; for its lines give it to "
                     "'voxelcore skeleton' first");
  }
  SkeletonModel model;
  model.unit = map->geometry.unit;
  model.parts = SkeletonsOfMasks(std::move(map->labels), map->geometry, options.making, side.name, progress);
  return model;
}

/** Chosen by --labels: by value. */
template <typename TParts>
void
KeepLabels(TParts & parts, const std::string & labels, const std::string & name)
{
  if (labels == "all")
  {
    return;
  }
  std::vector<std::int64_t> wanted;
  for (const std::string & text : SplitText(labels, ','))
  {
    const auto value = ParseReal(text);
    const auto has = [&](const auto & part) { return value && static_cast<double>(part.label) == *value; };
    if (ranges::none_of(parts, has))
    {
      throw InputError(name + ": has no label " + text + "; of skeletons and surfaces --labels takes values");
    }
    wanted.push_back(static_cast<std::int64_t>(*value));
  }
  std::erase_if(parts, [&](const auto & part) { return ranges::count(wanted, part.label) == 0; });
}

void
CompareSkeletons(CompareSide              a,
                 CompareSide              b,
                 const CompareOptions &   options,
                 CompareResult &          result,
                 const ProgressCallback & progress)
{
  const bool hasLabels = !IsTreePath(a.name) && !IsTreePath(b.name);
  for (const bool ofA : { true, false })
  {
    const std::string name = ofA ? a.name : b.name;
    SkeletonModel     model =
      TreesOf(std::move(ofA ? a : b), options, PartOfProgress(progress, ofA ? 0 : 0.4, ofA ? 0.4 : 0.8));
    if (!IsTreePath(name))
    {
      KeepLabels(model.parts, options.making.reading.labels, name);
    }
    if (!hasLabels && model.parts.size() > 1)
    {
      SkeletonPart merged;
      merged.label = 1;
      merged.name = fs::path(name).stem().string();
      merged.graph = MergedGraph(model);
      model.parts.clear();
      model.parts.push_back(std::move(merged));
    }
    (ofA ? result.treesA : result.treesB) = std::move(model);
  }
  RequireSameUnit(a.name, result.treesA.unit, b.name, result.treesB.unit);
  result.unit = result.treesA.unit;
  const TreeTolerance        tolerance{ NearOf(options, result.unit) };
  std::vector<ComparedTrees> labels;
  SkeletonModel              trees[2];
  for (const Pair & pair : Paired(
         result.treesA.parts,
         result.treesB.parts,
         [](const SkeletonPart & part) { return std::pair(part.label, part.component); },
         result.notes))
  {
    const SkeletonPart nothing;
    for (const bool ofA : { true, false })
    {
      const auto & index = ofA ? pair.a : pair.b;
      trees[ofA ? 0 : 1].parts.push_back(index ? (ofA ? result.treesA : result.treesB).parts[*index] : nothing);
    }
    const SkeletonPart & partA = trees[0].parts.back();
    const SkeletonPart & partB = trees[1].parts.back();
    ComparedTrees        compared;
    compared.label = pair.a ? partA.label : partB.label;
    compared.name = pair.a ? partA.name : partB.name;
    compared.found = CompareTrees(partA.graph, partB.graph, tolerance);
    const auto levels = [](const SkeletonPart & part) { return MeasureBranches(part.graph).levels; };
    compared.levelsA = levels(partA);
    compared.levelsB = levels(partB);
    result.matches.push_back({ compared.found.a, compared.found.b });
    labels.push_back(std::move(compared));
  }
  result.treesA.parts = std::move(trees[0].parts);
  result.treesB.parts = std::move(trees[1].parts);
  result.tables = TablesOf(labels, result.unit);
}

void
CompareSurfaces(CompareSide a, CompareSide b, const CompareOptions & options, CompareResult & result)
{
  auto & modelA = std::get<MedialModel>(a.content);
  auto & modelB = std::get<MedialModel>(b.content);
  KeepLabels(modelA.parts, options.making.reading.labels, a.name);
  KeepLabels(modelB.parts, options.making.reading.labels, b.name);
  RequireSameUnit(a.name, modelA.unit, b.name, modelB.unit);
  const double               near = NearOf(options, modelA.unit);
  std::vector<ComparedCores> labels;
  for (const Pair & pair : Paired(
         modelA.parts,
         modelB.parts,
         [](const ModelPart & part) { return std::pair(part.label, part.component); },
         result.notes))
  {
    const ModelPart   nothing;
    const ModelPart & partA = pair.a ? modelA.parts[*pair.a] : nothing;
    const ModelPart & partB = pair.b ? modelB.parts[*pair.b] : nothing;
    ComparedCores     compared;
    compared.label = pair.a ? partA.label : partB.label;
    compared.name = "label-" + std::to_string(compared.label);
    compared.found = CompareCores(partA.core, partB.core, near);
    labels.push_back(std::move(compared));
  }
  result.unit = modelA.unit;
  result.tables = TablesOf(labels, result.unit);
}

/** Poly lines of branches: those of A, found (0) or missed (1), and those of B that are invented (2). */
void
WriteFoundVtp(const fs::path & path, const CompareResult & result)
{
  VtpContent                content;
  std::vector<double>       radius;
  std::vector<std::int64_t> found;
  std::vector<std::int64_t> labels;
  std::vector<std::int64_t> branchIds;
  std::vector<double>       shares;
  for (std::size_t row = 0; row < result.matches.size(); ++row)
  {
    for (const bool ofA : { true, false })
    {
      const SkeletonPart & part = (ofA ? result.treesA : result.treesB).parts[row];
      const auto &         matches = result.matches[row][ofA ? 0 : 1];
      for (std::size_t branch = 0; branch < matches.size(); ++branch)
      {
        if (!ofA && matches[branch].IsFound())
        {
          continue;
        }
        for (const ElementIndex point : part.graph.Branch(branch))
        {
          content.cells[1].points.push_back(static_cast<std::int64_t>(radius.size()));
          const Vector3 & place = part.graph.positions[point];
          content.positions.insert(content.positions.end(), place.begin(), place.end());
          radius.push_back(SectionRadii(part.graph)[point]);
        }
        content.cells[1].offsets.push_back(static_cast<std::int64_t>(radius.size()));
        found.push_back(!ofA ? 2 : matches[branch].IsFound() ? 0 : 1);
        labels.push_back(part.label);
        branchIds.push_back(static_cast<std::int64_t>(branch));
        shares.push_back(matches[branch].share);
      }
    }
  }
  content.texts = { { "SPACE", "LPS" }, { "Units", UnitName(result.unit) } };
  content.pointArrays = { { "Radius", std::move(radius) } };
  content.cellArrays = { { "Found", std::move(found) },
                         { "Label", std::move(labels) },
                         { "BranchId", std::move(branchIds) },
                         { "Share", std::move(shares) } };
  WriteVtp(path, std::move(content));
}

/** The branches that were found, missed and invented, as labels of a page or scene. */
void
Show(DisplayFiles &             shown,
     const CompareResult &      result,
     std::vector<std::string> & notes,
     const ProgressCallback &   progress)
{
  CoreReport report;
  report.input.geometry.unit = result.unit;
  for (const char * name : { "found", "missed", "invented" })
  {
    const bool   ofA = name[0] != 'i';
    SkeletonPart part;
    part.graph = MergedGraph(ofA ? result.treesA : result.treesB, [&](std::size_t row, std::size_t branch) {
      return result.matches[row][ofA ? 0 : 1][branch].IsFound() == (name[0] == 'f');
    });
    part.table = MeasureBranches(part.graph);
    report.labels.emplace_back();
    report.labels.back().label = std::ssize(report.labels);
    report.labels.back().name = name;
    shown.AddLabel(report.labels.back(), ModelPart(), &part);
  }
  shown.OpenByLabel();
  shown.Finish(report, notes, progress);
}

/** CompareResult::kind. */
std::string
KindOf(const CompareSide & a, const CompareSide & b)
{
  const auto both = [&]<typename T>(std::type_identity<T>) {
    return std::holds_alternative<T>(a.content) && std::holds_alternative<T>(b.content);
  };
  return both(std::type_identity<LabelMap>())      ? "masks"
         : both(std::type_identity<MedialModel>()) ? "cores"
                                                   : "skeletons";
}

/** Arrays have no digest. */
Json
FileJson(const fs::path & path, const std::string & sha256)
{
  Json json = { { "path", path.string() } };
  if (!sha256.empty())
  {
    json["sha256"] = sha256;
  }
  return json;
}

void
Require(const std::optional<fs::path> & target, const char * option, const char * extension)
{
  if (target && target->extension() != extension)
  {
    throw UsageError(std::string(option) + " " + target->string() + ": unknown extension; give " + extension);
  }
}

} // namespace

CompareSide
ReadCompareSide(const fs::path &           path,
                const CompareOptions &     options,
                std::vector<std::string> & warnings,
                const ProgressCallback &   progress)
{
  CompareSide side{ path.string(), {} };
  if (IsTreePath(path))
  {
    side.content = ReadTreeFile(path);
    return side;
  }
  if (!IsFinishedCore(path, options.making.reading, options.making.resolution))
  {
    InputScan scan = ReadScanOrMesh(path, options.making.reading, options.making.resolution, progress);
    warnings.insert(warnings.end(), scan.warnings.begin(), scan.warnings.end());
    side.content = std::move(static_cast<LabelMap &>(scan));
    return side;
  }
  std::string rounded;
  try
  {
    SkeletonModel skeleton = ReadSkeletonVtp(path);
    rounded = skeleton.rounded;
    if (const CoreReport made = ParseProvenance(skeleton.provenance, path.string());
        made.labels.size() == skeleton.parts.size())
    {
      for (std::size_t i = 0; i < made.labels.size(); ++i)
      {
        skeleton.parts[i].name = made.labels[i].name;
      }
    }
    side.content = std::move(skeleton);
  }
  catch (const InputError &)
  {
    MedialModel model = ReadModel(path, Precision::AsSaved); // says what is wrong when it is neither
    rounded = model.rounded;
    side.content = std::move(model);
  }
  WarnOfRounding(path, rounded, warnings);
  return side;
}

CompareResult
Compare(CompareSide a, CompareSide b, const CompareOptions & options, const ProgressCallback & progress)
{
  CompareResult result;
  result.kind = KindOf(a, b);
  if (result.kind == "masks")
  {
    CompareMasks(std::move(a), std::move(b), options, result, progress);
  }
  else if (result.kind == "cores")
  {
    CompareSurfaces(std::move(a), std::move(b), options, result);
  }
  else
  {
    CompareSkeletons(std::move(a), std::move(b), options, result, progress);
  }
  return result;
}

CompareResult
RunCompareJob(const CompareOptions & options, const JobContext & given)
{
  const JobContext  context = ForwardOnly(given);
  OutputTransaction transaction(options.force, context.temporaries);
  transaction.Protect(options.a);
  transaction.Protect(options.b);
  Require(options.output, "--output", ".vtp");
  Require(options.table, "--table", ".csv");
  std::vector<fs::path> targets;
  for (const auto & target : { options.output, options.table, options.report })
  {
    if (target)
    {
      targets.push_back(*target);
    }
  }
  if (options.table)
  {
    for (const char * further : { "_differences", "_branches", "_levels" })
    {
      targets.push_back(FileOutputPath(*options.table, further));
    }
    targets.push_back(ColumnsBeside(*options.table));
  }
  CheckTargets(transaction, targets);
  DisplayFiles             shown(options.display, options.a, transaction);
  std::vector<std::string> warnings;
  CompareSide a = ReadCompareSide(options.a, options, warnings, PartOfProgress(context.progress, "reading", 0, 0.1));
  CompareSide b = ReadCompareSide(options.b, options, warnings, PartOfProgress(context.progress, "reading", 0.1, 0.2));
  if ((options.output || shown.AreAsked()) && KindOf(a, b) != "skeletons")
  {
    throw UsageError("--output, --html and --scene show branches of skeletons, which " + a.name + " and " + b.name +
                     " are not; leave them out, or give skeletons");
  }
  CompareResult result =
    Compare(std::move(a), std::move(b), options, PartOfProgress(context.progress, "comparing", 0.2, 0.95));
  result.warnings = std::move(warnings);
  ReportProgress(context.progress, "writing", 0.95);
  if (shown.AreAsked())
  {
    Show(shown, result, result.notes, PartOfProgress(context.progress, 0.95, 1));
  }
  if (options.output)
  {
    WriteFoundVtp(transaction.Stage(*options.output), result);
  }
  if (options.table)
  {
    for (const CompareTable & table : result.tables)
    {
      WriteCompareCsv(
        transaction.Stage(table.name == "labels" ? *options.table : FileOutputPath(*options.table, "_" + table.name)),
        table,
        context.Heads(result.unit));
    }
    WriteTextFile(transaction.Stage(ColumnsBeside(*options.table)), CompareColumnsJson(result.tables));
  }
  if (options.report)
  {
    result.sha256 = { ScanSha256(options.a, options.making.reading), ScanSha256(options.b, options.making.reading) };
    WriteTextFile(transaction.Stage(*options.report), CompareJson(result, options));
  }
  Finish(transaction, context);
  return result;
}

std::string
CompareJson(const CompareResult & result, const CompareOptions & options)
{
  Json json = { { "voxelcore", { { "version", VoxelCoreVersion() }, { "command", options.command } } },
                { "a", FileJson(options.a, result.sha256[0]) },
                { "b", FileJson(options.b, result.sha256[1]) },
                { "kind", result.kind },
                { "unit", UnitName(result.unit) },
                { "notes", result.notes },
                { "units", Json::object() } };
  for (const TextColumn & column : result.tables.front().columns)
  {
    if (!column.unit.empty() && column.unit != "1")
    {
      json["units"][column.name] = column.unit;
    }
  }
  json.update(TablesAsJson(result.tables));
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string
CompareText(const CompareResult & result)
{
  return CompareTablesText(result.tables);
}

} // namespace voxelcore
