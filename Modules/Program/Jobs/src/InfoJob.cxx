#include "voxelcore/Jobs/InfoJob.h"

#include "voxelcore/Base/LengthUnit.h"
#include "voxelcore/Base/Text.h"
#include "voxelcore/Jobs/JobTools.h"
#include "voxelcore/Jobs/OutputNames.h"
#include "voxelcore/Jobs/ReadInput.h"
#include "voxelcore/Report/ReportTable.h"
#include "voxelcore/Shape/ShapeTopology.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <omp.h>
#include <utility>

namespace voxelcore
{

namespace
{

/** Lengths along i, j, k or x, y, z in `unit`. */
std::string
LengthsText(const Vector3 & mm, const LengthUnit & unit, const std::string & between)
{
  return ShortText(unit.Of(mm[0])) + between + ShortText(unit.Of(mm[1])) + between + ShortText(unit.Of(mm[2])) + " " +
         unit.Name();
}

/** Rough, as predictions are. */
std::string
SecondsText(double seconds)
{
  return seconds < 90 ? DecimalText(seconds, seconds < 10 ? 1 : 0) + " s" : DecimalText(seconds / 60, 0) + " min";
}

std::string
BoxText(const VoxelBox & box)
{
  std::string text;
  for (std::size_t k = 0; k < 3; ++k)
  {
    text += (k > 0 ? " " : "") + std::to_string(box.lower[k]) + ".." + std::to_string(box.lower[k] + box.size[k] - 1);
  }
  return text;
}

std::string
BettiText(const TopologyNumbers & numbers)
{
  const auto & [pieces, loops, cavities] = numbers.betti;
  return std::to_string(pieces) + "/" + std::to_string(loops) + "/" + std::to_string(cavities);
}

/** Bars as long as their share of the longest. */
std::string
HistogramText(const GreyScan & grey)
{
  constexpr std::uint64_t longest = 50;
  const std::uint64_t     most = std::max<std::uint64_t>(1, *std::max_element(grey.counts.begin(), grey.counts.end()));
  const auto  all = static_cast<double>(std::accumulate(grey.counts.begin(), grey.counts.end(), std::uint64_t{ 0 }));
  std::string text = "      from   voxels\n";
  for (std::size_t b = 0; b < grey.counts.size(); ++b)
  {
    char line[64];
    (void)std::snprintf(line,
                        sizeof(line),
                        "%10.4g  %5.1f %%  ",
                        grey.edges[b],
                        100 * static_cast<double>(grey.counts[b]) / all);
    text += line + std::string((grey.counts[b] * longest + most - 1) / most, '#') + "\n";
  }
  return text;
}

std::string
GreyText(const ScanInfo & info)
{
  std::vector<std::vector<std::string>> rows{
    { "threshold", "", "voxels", "of all %", "pieces", "loops", "cavities" }
  };
  const auto all = static_cast<double>(info.geometry.size[0]) * static_cast<double>(info.geometry.size[1]) *
                   static_cast<double>(info.geometry.size[2]);
  for (const GreyProposal & one : info.proposals)
  {
    const auto & [pieces, loops, cavities] = one.topology.betti;
    rows.push_back({ ShortText(one.threshold, 6) + ":inf",
                     one.name,
                     std::to_string(one.voxels),
                     ShortText(100 * static_cast<double>(one.voxels) / all, 3),
                     std::to_string(pieces),
                     std::to_string(loops),
                     std::to_string(cavities) });
  }
  return "\n" + GreyScanText(*info.grey) + "\n\n" + HistogramText(*info.grey) + "\n" + FormatTable(rows) +
         "\ngive --threshold " + ProposedRange(*info.grey) +
         ", or another range; give --labels all if its values are labels\n";
}

/** What a threshold would make of a grey scan, which is read once more. */
GreyProposal
Propose(const InfoOptions & options, const std::string & name, double threshold)
{
  GreyProposal proposal{ name, threshold, 0, {} };
  ReadOptions  reading = options.reading;
  reading.threshold = std::pair(threshold, std::numeric_limits<double>::infinity());
  reading.refuseGrey = false;
  InputScan          scan = ReadScanOrMesh(options.scan, reading, options.resolution);
  const EditedLabels edited =
    EditLabels(std::move(scan.labels), scan.geometry, options.edits, false, options.scan.string());
  for (const EditedLabel & one : edited.labels) // with components apart there are several
  {
    const TopologyNumbers topology = ComputeShapeTopology(one.label.shape);
    proposal.voxels += one.label.voxels;
    proposal.topology.euler += topology.euler;
    for (std::size_t k = 0; k < 3; ++k)
    {
      proposal.topology.betti[k] += topology.betti[k];
    }
  }
  return proposal;
}

} // namespace

std::string
OrientationLetters(const ImageGeometry & geometry)
{
  // LPS: the first coordinate grows to the Left, the second to the Posterior, the third to the Superior.
  static constexpr char positive[] = "LPS";
  static constexpr char negative[] = "RAI";
  std::string           letters;
  std::array<bool, 3>   taken{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    std::size_t best = 3;
    for (std::size_t row = 0; row < 3; ++row)
    {
      // Axes at 45 degrees: no letter twice.
      if (!taken[row] &&
          (best == 3 || std::abs(geometry.direction[3 * row + axis]) > std::abs(geometry.direction[3 * best + axis])))
      {
        best = row;
      }
    }
    taken[best] = true;
    letters += geometry.direction[3 * best + axis] >= 0 ? positive[best] : negative[best];
  }
  return letters;
}

ScanInfo
RunInfoJob(const InfoOptions & options, const JobContext & given)
{
  const JobContext context = ForwardOnly(given);
  StagePlan        plan(context.progress, { 0.4, 0.2, 0.4 });
  ScanInfo         info;
  InputScan        volume;
  try
  {
    volume = ReadScanOrMesh(options.scan, options.reading, options.resolution, plan.Next("reading"));
  }
  catch (const GreyScanError & error)
  {
    info.grey = error.grey;
    volume = { error.scan, {} };
  }
  const ProgressCallback editing = plan.Next();
  EditedLabels           edited;
  if (!info.grey)
  {
    edited = EditLabels(std::move(volume.labels),
                        volume.geometry,
                        options.edits,
                        options.reading.labels != "all",
                        options.scan.string(),
                        editing);
  }
  const ProgressCallback counting = plan.Next("counting");
  info.path = options.scan.string();
  info.format = std::move(volume.format);
  info.pixelType = std::move(volume.pixelType);
  info.geometry = volume.geometry;
  info.orientation = OrientationLetters(info.geometry);
  info.notes = std::move(volume.notes);
  info.notes.insert(info.notes.end(), edited.notes.begin(), edited.notes.end());
  info.warnings = std::move(volume.warnings);
  std::optional<VoxelBox> border; // none where no core can be made
  try
  {
    const SpacingWeights weights = ScanWeights(info.geometry, options.scan);
    border = BorderOf(volume);
    for (std::string & warning : DiagnoseLabels(edited.labels, weights.weight))
    {
      info.warnings.push_back(std::move(warning));
    }
  }
  catch (const InputError & error)
  {
    info.warnings.push_back(std::string("no core can be made: ") + error.what());
  }
  info.threads = omp_get_max_threads();
  if (info.grey)
  {
    for (const auto & [name, threshold] :
         { std::pair("proposed", info.grey->proposed), std::pair("by Otsu", info.grey->otsu) })
    {
      info.proposals.push_back(Propose(options, name, threshold));
    }
    ReportProgress(context.progress, "done", 1);
    return info;
  }
  const std::vector<BoundaryCounts> boundaries = CountBoundaries(edited.labels);
  CoreOptions                       defaults;
  defaults.lambdas = options.coreLambdas;
  defaults.tolerances = options.coreTolerances;
  defaults.refine.surface = options.coreRefined ? "labels" : "";
  defaults.output = "medial.vtp";
  info.core = PredictJob(boundaries, defaults, info.threads);
  CoreOptions page = defaults;
  page.display.html = "medial.html";
  info.page = PredictJob(boundaries, page, info.threads);
  CoreOptions skeletons;
  skeletons.lambdas = options.skeletonLambdas;
  skeletons.skeleton.emplace().border = options.skeletonBorder;
  skeletons.skeletonOutput = "skeleton.vtp";
  info.skeleton = PredictJob(
    border ? CountBoundariesUpToBorder(edited.labels, info.geometry, *border, *skeletons.skeleton) : boundaries,
    skeletons,
    info.threads);
  const double voxelMm3 = info.geometry.spacing[0] * info.geometry.spacing[1] * info.geometry.spacing[2];
  for (const auto & [label, component, edits, hollow, diagnosis] : edited.labels)
  {
    ReportProgress(counting, "", static_cast<double>(info.labels.size()) / static_cast<double>(edited.labels.size()));
    LabelInfo one;
    one.label = label.value;
    one.component = component;
    one.name = label.name;
    one.voxels = label.voxels;
    one.volumeMm3 = static_cast<double>(label.voxels) * voxelMm3;
    one.box = label.shape.Box();
    one.topology = ComputeShapeTopology(label.shape);
    one.closed = ComputeClosedTopology(label.shape);
    one.boundary = boundaries[info.labels.size()];
    one.cost = PredictJob({ one.boundary }, defaults, info.threads);
    info.labels.push_back(std::move(one));
  }
  ReportProgress(context.progress, "done", 1);
  return info;
}

namespace
{

std::string
CostText(const CostPrediction & cost)
{
  return MemoryText(cost.memoryBytes) + " and " + SecondsText(cost.seconds);
}

nlohmann::ordered_json
CostJson(const CostPrediction & cost, int threads)
{
  return { { "memory_bytes", cost.memoryBytes }, { "seconds", cost.seconds }, { "threads", threads } };
}

} // namespace

std::string
InfoText(const ScanInfo & info)
{
  const auto & geometry = info.geometry;
  std::string  text = info.path + "\n";
  text += "format       " + info.format + ", " + info.pixelType + "\n";
  text += "size         " + std::to_string(geometry.size[0]) + " x " + std::to_string(geometry.size[1]) + " x " +
          std::to_string(geometry.size[2]) + " voxels\n";
  const LengthUnit voxelUnit =
    LengthUnit::For(*std::max_element(geometry.spacing.begin(), geometry.spacing.end()), geometry.unit);
  text += "spacing      " + LengthsText(geometry.spacing, voxelUnit, " x ") + "\n";
  text += "origin       " + LengthsText(geometry.origin, voxelUnit, ", ") + " (LPS)\n";
  text += "orientation  " + info.orientation + " (where i, j and k run to)\n";
  if (info.core)
  {
    text += "core needs   about " + CostText(*info.core) + " (" + std::to_string(info.threads) +
            (info.threads == 1 ? " thread" : " threads") + ", default pruning and refinement, one file)\n";
  }
  if (info.page)
  {
    text += "with a page  about " + CostText(*info.page) + " (core --html; within a factor of two)\n";
  }
  if (info.skeleton)
  {
    text += "skeleton     at most about " + CostText(*info.skeleton) + " (within a factor of two)\n";
  }
  for (const std::string & note : info.notes)
  {
    text += "note         " + note + "\n";
  }
  if (info.grey)
  {
    return text + GreyText(info);
  }
  double largest = 0;
  for (const LabelInfo & label : info.labels)
  {
    largest = std::max(largest, label.volumeMm3);
  }
  const LengthUnit                      unit = LengthUnit::For(std::cbrt(largest), geometry.unit);
  std::vector<std::vector<std::string>> rows{ { "label",
                                                "name",
                                                "voxels",
                                                "volume " + unit.Name(3),
                                                "voxel box",
                                                "b0/b1/b2",
                                                "b0/b1/b2 by 26",
                                                "boundary vertices" } };
  for (const LabelInfo & label : info.labels)
  {
    rows.push_back({ std::to_string(label.label),
                     label.name,
                     std::to_string(label.voxels),
                     unit.Text(label.volumeMm3, 3, 3),
                     BoxText(label.box),
                     BettiText(label.topology),
                     BettiText(label.closed),
                     std::to_string(label.boundary.vertices) });
  }
  text += "\n" + FormatTable(rows);
  return text;
}

std::string
InfoJson(const ScanInfo & info)
{
  using Json = nlohmann::ordered_json;
  Json labels = Json::array();
  for (const LabelInfo & label : info.labels)
  {
    Json one = { { "label", label.label } };
    if (label.component != 0)
    {
      one["component"] = label.component;
    }
    one.update(Json{ { "name", label.name },
                     { "voxels", label.voxels },
                     { "volume_mm3", label.volumeMm3 },
                     { "bounding_box", { { "lower", label.box.lower }, { "size", label.box.size } } },
                     { "euler", label.topology.euler },
                     { "betti", label.topology.betti },
                     { "components_26", label.closed.betti[0] },
                     { "euler_26", label.closed.euler },
                     { "betti_26", label.closed.betti },
                     { "boundary_vertices", label.boundary.vertices },
                     { "core_memory_bytes", label.cost.memoryBytes },
                     { "core_seconds", label.cost.seconds } });
    labels.push_back(std::move(one));
  }
  Json json = { { "path", info.path },
                { "format", info.format },
                { "pixel_type", info.pixelType },
                { "size", info.geometry.size },
                { "spacing_mm", info.geometry.spacing },
                { "origin_mm", info.geometry.origin },
                { "direction", info.geometry.direction },
                { "orientation", info.orientation },
                { "notes", info.notes },
                { "warnings", info.warnings } };
  if (info.geometry.unit == SpatialUnit::Voxels)
  {
    json["unit"] = UnitName(info.geometry.unit);
  }
  if (info.core)
  {
    json["core"] = CostJson(*info.core, info.threads);
  }
  if (info.skeleton)
  {
    json["skeleton"] = CostJson(*info.skeleton, info.threads);
  }
  if (info.page)
  {
    json["page"] = CostJson(*info.page, info.threads);
  }
  json["labels"] = labels;
  if (info.grey)
  {
    Json proposals = Json::array();
    for (const GreyProposal & one : info.proposals)
    {
      proposals.push_back({ { "name", one.name },
                            { "threshold", one.threshold },
                            { "voxels", one.voxels },
                            { "betti", one.topology.betti } });
    }
    json["grey"] = { { "values", info.grey->distinct },
                     { "lowest", info.grey->lowest },
                     { "highest", info.grey->highest },
                     { "otsu", info.grey->otsu },
                     { "threshold", ProposedRange(*info.grey) },
                     { "proposals", proposals },
                     { "histogram", { { "edges", info.grey->edges }, { "voxels", info.grey->counts } } } };
  }
  json = KeysInUnit(json, info.geometry.unit);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace voxelcore
