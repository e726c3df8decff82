#include "voxelcore/Jobs/ReconstructJob.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/LengthUnit.h"
#include "voxelcore/Base/Text.h"
#include "voxelcore/Imaging/GreyVolume.h"
#include "voxelcore/Imaging/LabelVolume.h"
#include "voxelcore/Jobs/JobTools.h"
#include "voxelcore/Jobs/ReadInput.h"
#include "voxelcore/Masks/ShapeEdits.h"
#include "voxelcore/Report/ReportTable.h"
#include "voxelcore/Shape/BoundaryVertices.h"
#include "voxelcore/Verification/BallCoverage.h"
#include "voxelcore/VoxelCore/BallUnion.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

namespace voxelcore
{

namespace
{

using Json = nlohmann::ordered_json;

/** The balls of a label, all its components', in lattice coordinates and mm. */
struct Balls
{
  std::vector<std::array<double, 3>> centres;
  std::vector<double>                radius;
};

void
AddBalls(const ModelPart & part, const ImageGeometry & geometry, Balls & balls)
{
  for (const auto & position : part.core.positions)
  {
    balls.centres.push_back(PhysicalToLattice(geometry, position));
  }
  balls.radius.insert(balls.radius.end(), part.core.radius.begin(), part.core.radius.end());
}

/** The part of the grid that the balls may reach. */
VoxelBox
BoxAround(const Balls & balls, const ImageGeometry & geometry)
{
  VoxelBox box;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const auto most = static_cast<double>(geometry.size[k]);
    double     lower = most;
    double     upper = 0;
    for (std::size_t i = 0; i < balls.radius.size(); ++i)
    {
      const double reach = balls.radius[i] / geometry.spacing[k] + 1;
      lower = std::min(lower, std::floor(balls.centres[i][k] - reach));
      upper = std::max(upper, std::ceil(balls.centres[i][k] + reach));
    }
    box.lower[k] = static_cast<std::int32_t>(std::clamp(lower, 0.0, most));
    box.size[k] = static_cast<std::int32_t>(std::clamp(upper, 0.0, most)) - box.lower[k];
    box.size[k] = std::max(box.size[k], 0);
  }
  return box;
}

/** Takes the voxels that others have out and lets `taken` have the rest. Returns how many went. */
std::uint64_t
Claim(VoxelShape & shape, VoxelShape & taken)
{
  const VoxelBox & box = shape.Box();
  std::uint64_t    contested = 0;
  for (std::int32_t z = 0; z < box.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < box.size[1]; ++y)
    {
      const auto own = shape.Row(y, z);
      for (std::size_t word = 0; word < own.size(); ++word)
      {
        for (std::uint64_t bits = own[word]; bits != 0; bits &= bits - 1)
        {
          const auto x = static_cast<std::int32_t>(64 * word) + std::countr_zero(bits) + box.lower[0];
          if (taken.Contains(x, y + box.lower[1], z + box.lower[2]))
          {
            own[word] &= ~(bits & (~bits + 1));
            ++contested;
          }
          else
          {
            taken.Insert(x, y + box.lower[1], z + box.lower[2]);
          }
        }
      }
    }
  }
  return contested;
}

std::uint64_t
CountCommon(const VoxelShape & a, const VoxelShape & b)
{
  const VoxelBox & box = a.Box();
  std::uint64_t    count = 0;
  for (std::int32_t z = 0; z < box.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < box.size[1]; ++y)
    {
      const auto row = a.Row(y, z);
      for (std::size_t word = 0; word < row.size(); ++word)
      {
        for (std::uint64_t bits = row[word]; bits != 0; bits &= bits - 1)
        {
          const auto x = static_cast<std::int32_t>(64 * word) + std::countr_zero(bits) + box.lower[0];
          count += b.Contains(x, y + box.lower[1], z + box.lower[2]) ? 1U : 0U;
        }
      }
    }
  }
  return count;
}

/** From a boundary vertex of one shape to the nearest of the other, in mm. */
double
LargestDistance(const VoxelShape & from, const VoxelShape & to, const SpacingWeights & weights)
{
  std::vector<std::array<double, 3>> places;
  for (const LatticePoint & p : BoundaryVertices(to))
  {
    places.push_back({ static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z) });
  }
  return LargestBoundaryGap(from, weights, places, std::vector<double>(places.size(), 0.0)).largest;
}

ReconstructComparison
Compare(const VoxelShape & rebuilt, const VoxelShape & scan, const Balls & balls, const ImageGeometry & geometry)
{
  const SpacingWeights  weights = ComputeSpacingWeights(geometry.spacing);
  ReconstructComparison result;
  result.voxels = scan.CountVoxels();
  result.dice =
    2 * static_cast<double>(CountCommon(rebuilt, scan)) / static_cast<double>(rebuilt.CountVoxels() + result.voxels);
  result.surfaceDistanceMm = std::max(LargestDistance(rebuilt, scan, weights), LargestDistance(scan, rebuilt, weights));
  result.boundaryGapMm = LargestBoundaryGap(scan, weights, balls.centres, balls.radius).largest;
  return result;
}

/** The scan's labels as they were when the core was made. */
std::vector<LabelShape>
ReadScanLabels(const std::filesystem::path & scan,
               CoreReport &                  made,
               std::vector<std::string> &    warnings,
               const ProgressCallback &      progress)
{
  LabelMap volume = ReadScanAgain(scan, made.parameters, warnings, progress);
  warnings.insert(warnings.end(), volume.warnings.begin(), volume.warnings.end());
  if (volume.geometry.size != made.input.geometry.size)
  {
    throw InputError(scan.string() + ": has another size than the scan the core was made from; give that one");
  }
  ShapeEditOptions edits = made.parameters.edits;
  edits.splitComponents = false; // the balls of all components of a label are one volume
  EditedLabels            edited = EditLabels(std::move(volume.labels),
                                   volume.geometry,
                                   edits,
                                   !made.parameters.reading.binary && !made.parameters.reading.threshold,
                                   scan.string());
  std::vector<LabelShape> labels;
  for (EditedLabel & one : edited.labels)
  {
    labels.push_back(std::move(one.label));
  }
  return labels;
}

std::string
ReportJson(const ReconstructResult & result)
{
  Json json;
  json["voxelcore"] = { { "version", VoxelCoreVersion() }, { "command", result.command } };
  json["core"] = result.core;
  json["size"] = result.geometry.size;
  json["spacing_mm"] = result.geometry.spacing;
  json["origin_mm"] = result.geometry.origin;
  json["direction"] = result.geometry.direction;
  json["labels"] = Json::array();
  for (const ReconstructedLabel & label : result.labels)
  {
    Json one = { { "label", label.label },
                 { "name", label.name },
                 { "voxels", label.voxels },
                 { "contested", label.contested } };
    if (label.comparison)
    {
      one["scan_voxels"] = label.comparison->voxels;
      one["dice"] = label.comparison->dice;
      one["largest_surface_distance_mm"] = label.comparison->surfaceDistanceMm;
      one["boundary_gap_mm"] = label.comparison->boundaryGapMm;
    }
    json["labels"].push_back(std::move(one));
  }
  if (result.geometry.unit == SpatialUnit::Voxels)
  {
    json["unit"] = UnitName(result.geometry.unit);
  }
  json = KeysInUnit(json, result.geometry.unit);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void
CheckTargets(const ReconstructOptions & options, OutputTransaction & transaction)
{
  if (options.like && options.scan)
  {
    throw UsageError("give only one of --like and --scan: what is compared with a scan is made on its grid");
  }
  for (const auto & input : { std::optional(options.core), options.like, options.scan })
  {
    if (input)
    {
      transaction.Protect(*input);
    }
  }
  RequireVolumePath(options.output);
  transaction.CheckTarget(options.output);
  if (options.report)
  {
    transaction.CheckTarget(*options.report);
  }
}

} // namespace

ReconstructResult
RunReconstructJob(const ReconstructOptions & options, const JobContext & given)
{
  const JobContext  context = ForwardOnly(given);
  OutputTransaction transaction(options.force, context.temporaries);
  CheckTargets(options, transaction);
  ReportProgress(context.progress, "reading", 0);
  const MedialModel model = ReadModel(options.core, Precision::AsSaved);
  CoreReport        made = ParseProvenance(model.provenance, options.core.string());
  RequireFittingProvenance(made.labels.size() == model.parts.size(), options.core);
  ReconstructResult result;
  WarnOfRounding(options.core, model.rounded, result.warnings);
  result.command = options.command;
  result.core = options.core.string();
  result.geometry = made.input.geometry;
  if (options.like)
  {
    LabelMap like = ReadLabelVolume(*options.like, ReadOptions(), PartOfProgress(context.progress, "reading", 0, 0.1));
    RequireSameUnit(options.core, made.input.geometry.unit, *options.like, like.geometry.unit);
    result.geometry = like.geometry;
    result.warnings.insert(result.warnings.end(), like.warnings.begin(), like.warnings.end());
  }
  std::vector<LabelShape> scan;
  if (options.scan)
  {
    scan = ReadScanLabels(*options.scan, made, result.warnings, PartOfProgress(context.progress, "reading", 0, 0.1));
  }
  VoxelBox whole;
  for (std::size_t k = 0; k < 3; ++k)
  {
    whole.size[k] = static_cast<std::int32_t>(result.geometry.size[k]);
  }
  VoxelShape              taken(whole);
  std::vector<LabelShape> labels;
  for (std::size_t i = 0; i < model.parts.size();)
  {
    const std::int64_t value = model.parts[i].label;
    const auto         share = [&](std::size_t done) {
      return 0.1 + 0.8 * static_cast<double>(done) / static_cast<double>(model.parts.size());
    };
    const double       from = share(i);
    ReconstructedLabel one;
    one.label = value;
    one.name =
      made.labels[i].name.substr(0, made.labels[i].component > 0 ? made.labels[i].name.rfind('#') : std::string::npos);
    Balls balls;
    for (; i < model.parts.size() && model.parts[i].label == value; ++i)
    {
      AddBalls(model.parts[i], result.geometry, balls);
    }
    VoxelShape shape = UnionOfBalls(BoxAround(balls, result.geometry),
                                    result.geometry.spacing,
                                    balls.centres,
                                    balls.radius,
                                    PartOfProgress(context.progress, "balls", from, share(i)));
    one.contested = Claim(shape, taken);
    shape = CropToVoxels(shape);
    one.voxels = shape.CountVoxels();
    const auto place = std::find_if(scan.begin(), scan.end(), [&](const LabelShape & l) { return l.value == value; });
    if (options.scan && place == scan.end())
    {
      throw InputError(options.scan->string() + ": label " + std::to_string(value) + " of " + options.core.string() +
                       " does not occur in this scan; give the scan it was made from");
    }
    if (one.voxels == 0)
    {
      result.notes.push_back(LabelText(value, one.name) + ": no voxel's centre lies in its balls");
    }
    else
    {
      if (options.scan)
      {
        one.comparison = Compare(shape, place->shape, balls, result.geometry);
      }
      labels.push_back({ value, one.name, one.voxels, std::move(shape) });
    }
    result.labels.push_back(std::move(one));
  }
  if (labels.empty())
  {
    throw InputError(
      options.core.string() +
      ": no voxel's centre lies in its balls, so the volume would be empty; give a finer grid with --like");
  }
  ReportProgress(context.progress, "writing", 0.9);
  WriteLabelVolume(transaction.StageWithCompanions(options.output), result.geometry, labels);
  if (options.report)
  {
    WriteTextFile(transaction.Stage(*options.report), ReportJson(result));
  }
  Finish(transaction, context);
  return result;
}

std::string
ReconstructText(const ReconstructResult & result)
{
  const bool compared = std::any_of(result.labels.begin(), result.labels.end(), [](const ReconstructedLabel & l) {
    return l.comparison.has_value();
  });
  double     longest = 0;
  for (const ReconstructedLabel & label : result.labels)
  {
    if (label.comparison)
    {
      longest = std::max({ longest, label.comparison->surfaceDistanceMm, label.comparison->boundaryGapMm });
    }
  }
  const LengthUnit                      unit = LengthUnit::For(longest, result.geometry.unit);
  std::vector<std::vector<std::string>> rows{ { "label", "name", "voxels", "contested" } };
  if (compared)
  {
    rows.front().insert(rows.front().end(), { "in scan", "Dice", "surface " + unit.Name(), "balls " + unit.Name() });
  }
  for (const ReconstructedLabel & label : result.labels)
  {
    rows.push_back(
      { std::to_string(label.label), label.name, std::to_string(label.voxels), std::to_string(label.contested) });
    if (label.comparison)
    {
      const ReconstructComparison & c = *label.comparison;
      rows.back().insert(rows.back().end(),
                         { std::to_string(c.voxels),
                           FixedText(c.dice, 4),
                           unit.Text(c.surfaceDistanceMm, 1, 3),
                           unit.Text(c.boundaryGapMm, 1, 3) });
    }
  }
  return FormatTable(rows);
}

} // namespace voxelcore
