#include "PlannedBlock.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/OutputStream.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Formats/RawLayout.h"
#include "voxelcore/Imaging/LabelVolume.h"
#include "voxelcore/Jobs/JobTools.h"
#include "voxelcore/Jobs/OutputNames.h"
#include "voxelcore/Jobs/ReadInput.h"
#include "voxelcore/Labels/CropRange.h"

#include <algorithm>
#include <fstream>

namespace voxelcore
{
namespace
{

namespace fs = std::filesystem;

/** The voxels that the labels need; nothing when they need none. */
std::optional<CropRange>
RegionOfAll(const ScanPlan & plan, std::size_t block)
{
  std::optional<CropRange> all;
  for (const PlannedLabel & label : plan.labels)
  {
    const auto & [box, voxels, digest] = label.regions.at(block);
    if (voxels == 0)
    {
      continue;
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const std::int32_t end = box.lower[axis] + box.size[axis];
      if (!all)
      {
        all = CropRange{ box.lower, { 0, 0, 0 } };
      }
      all->first[axis] = std::min(all->first[axis], box.lower[axis]);
      all->end[axis] = std::max(all->end[axis], end);
    }
  }
  return all;
}

std::optional<ScanPlan>
FindPlan(const BlockOptions & options)
{
  std::ifstream file(PlanPath(options), std::ios::binary);
  if (!file)
  {
    return std::nullopt;
  }
  try
  {
    ScanPlan   plan = ReadScanPlan(file, PlanPath(options).string());
    const bool fits = ranges::all_of(plan.labels, [&](const PlannedLabel & label) {
      return label.plan.blocks.size() == options.blocks;
    });
    return fits && plan.source == PlanSource(options) ? std::optional(std::move(plan)) : std::nullopt;
  }
  catch (const InputError &) // damaged, or another version's: made anew
  {
    return std::nullopt;
  }
}

/** Without its date: equal scans have equal plans. What is not seen here, the region's digest and the join see. */
std::string
FileText(const fs::path & path)
{
  std::error_code ignored;
  const auto      size = fs::is_regular_file(path, ignored) ? fs::file_size(path, ignored) : 0;
  return Text(path.filename().string(), " ", size, "\n");
}

} // namespace

bool
CanReadBlockAlone(const BlockOptions & options)
{
  return !options.core.edits.AreAsked() && (options.core.reading.raw || !IsMeshFile(options.core.scan));
}

fs::path
PlanPath(const BlockOptions & options)
{
  return options.core.output / (ScanName(options.core.scan) + "_blocks-" + std::to_string(options.blocks) + ".vcp");
}

std::string
PlanSource(const BlockOptions & options)
{
  const fs::path &    scan = options.core.scan;
  const ReadOptions & reading = options.core.reading;
  const auto          number = [](const auto & value) { return value ? std::to_string(*value) : std::string("-"); };
  std::string         text = FileText(scan);
  for (const char * part : { ".zattrs", ".zgroup", ".zarray", "zarr.json" })
  {
    text += fs::exists(scan / part) ? FileText(scan / part) : std::string();
  }
  text += Text("labels ", reading.labels, reading.binary ? " binary" : "", "\n");
  if (reading.threshold)
  {
    text += Text("threshold ", Number(reading.threshold->first), ":", Number(reading.threshold->second), "\n");
  }
  if (reading.spacing)
  {
    text += "spacing";
    for (const double side : *reading.spacing)
    {
      text += " " + Number(side);
    }
    text += "\n";
  }
  text += Text("crop ", reading.crop ? CropText(*reading.crop) : "-", "\n");
  text += Text("raw ", reading.raw ? RawLayoutText(*reading.raw) : "-", "\n");
  text += Text("volume ", number(reading.volume), " component ", number(reading.component), " level ");
  return text + number(reading.level) + (reading.orthonormalize ? " orthonormalize\n" : "\n");
}

std::optional<PlannedBlock>
ReadPlannedBlock(const BlockOptions & options, const ProgressCallback & progress)
{
  const std::size_t block = options.block - 1;
  PlannedBlock      found;
  if (std::optional<ScanPlan> plan = FindPlan(options))
  {
    found.plan = std::move(*plan);
  }
  else
  {
    return std::nullopt;
  }
  found.shapes.resize(found.plan.labels.size());
  found.weights.weight = found.plan.labels.at(0).plan.weight;
  const std::optional<CropRange> region = RegionOfAll(found.plan, block);
  if (!region)
  {
    return found;
  }
  ReadOptions reading = options.core.reading;
  reading.crop = region;
  reading.refuseGrey = false; // which has been looked at
  if (!reading.binary && !reading.threshold)
  {
    reading.labels = "all"; // not each of those asked for is in every region
  }
  LabelMap part;
  try
  {
    part = ReadLabelVolume(options.core.scan, reading, progress);
  }
  catch (const InputError &) // reading all of it says what is wrong
  {
    return std::nullopt;
  }
  found.weights = ScanWeights(part.geometry, options.core.scan);
  found.warnings = std::move(part.warnings);
  for (std::size_t i = 0; i < found.plan.labels.size(); ++i)
  {
    const PlannedLabel & planned = found.plan.labels[i];
    const auto           same =
      ranges::find_if(part.labels, [&](const LabelShape & label) { return label.value == planned.value; });
    if (same != part.labels.end())
    {
      found.shapes[i] = std::move(same->shape);
    }
    if (planned.plan.weight != found.weights.weight || !IsRegionOf(planned.regions[block], found.shapes[i]))
    {
      return std::nullopt;
    }
  }
  return found;
}

void
KeepPlan(const ScanPlan & plan, const BlockOptions & options, const JobContext & context)
{
  OutputTransaction transaction(true, context.temporaries);
  OutputStream      file(transaction.Stage(PlanPath(options)));
  try
  {
    WriteScanPlan(plan, file);
  }
  catch (const OutputError &)
  {
    file.Finish(); // knows why
    throw;
  }
  file.Finish();
  transaction.Commit();
}

} // namespace voxelcore
