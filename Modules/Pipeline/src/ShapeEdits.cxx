#include "voxelcore/ShapeEdits.h"

#include "JobTools.h"
#include "voxelcore/Error.h"
#include "voxelcore/ShapeOperations.h"

#include <algorithm>
#include <charconv>
#include <utility>

namespace voxelcore
{

namespace
{

/** A voxel index; `open` for an empty text; none for what is no index. */
std::optional<std::int32_t>
ParseIndex(std::string_view text, std::int32_t open)
{
  if (text.empty())
  {
    return open;
  }
  std::int32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < 0)
  {
    return std::nullopt;
  }
  return value;
}

std::string
CropText(const CropRange & crop)
{
  std::string text;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const bool whole = crop.first[axis] == 0 && crop.end[axis] == 0;
    text += (axis > 0 ? "," : "") + (whole ? std::string() : std::to_string(crop.first[axis])) + ":" +
            (crop.end[axis] > 0 ? std::to_string(crop.end[axis]) : std::string());
  }
  return text;
}

CropRange
Resolved(CropRange crop, const ImageGeometry & geometry, const std::string & where)
{
  const std::string given = CropText(crop);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::int64_t size = geometry.size[axis];
    crop.end[axis] = crop.end[axis] > 0 ? crop.end[axis] : static_cast<std::int32_t>(size);
    if (crop.first[axis] >= size || crop.end[axis] > size)
    {
      throw InputError(where + ": --crop " + given + " reaches beyond the scan of " + std::to_string(geometry.size[0]) +
                       " x " + std::to_string(geometry.size[1]) + " x " + std::to_string(geometry.size[2]) +
                       " voxels; 'voxelcore info' tells where the labels lie");
    }
  }
  return crop;
}

EditRecord
EditShape(VoxelShape & shape, const ShapeEditOptions & options)
{
  EditRecord record;
  const auto take = [&shape](EditedShape edited) {
    shape = std::move(edited.shape);
    edited.shape = VoxelShape();
    return edited;
  };
  const auto takeRemoved = [&](EditedShape edited) {
    record.componentsRemoved += edited.componentsRemoved;
    record.voxelsRemoved += edited.voxelsRemoved;
    shape = std::move(edited.shape);
  };
  if (options.crop)
  {
    VoxelBox box{ options.crop->first, {} };
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      box.size[axis] = options.crop->end[axis] - options.crop->first[axis];
    }
    record.voxelsCropped = take(CropToBox(std::move(shape), box)).voxelsRemoved;
  }
  // Filled first: a hollow thing counts as the solid it becomes, and dust in its cavity is no component any longer.
  if (options.fillCavities)
  {
    const EditedShape filled = take(FillCavities(std::move(shape)));
    record.cavitiesFilled = filled.cavitiesFilled;
    record.voxelsAdded = filled.voxelsAdded;
    record.componentsJoined = filled.componentsJoined;
  }
  if (options.minVoxels)
  {
    takeRemoved(RemoveSmallComponents(std::move(shape), *options.minVoxels));
  }
  if (options.largest)
  {
    takeRemoved(KeepLargestComponents(std::move(shape), *options.largest));
  }
  return record;
}

void
Append(LabelShape label, const EditRecord & record, bool split, std::vector<EditedLabel> & labels)
{
  if (!split)
  {
    label.voxels = label.shape.CountVoxels();
    labels.push_back({ std::move(label), 0, record });
    return;
  }
  std::vector<VoxelShape> parts = SplitComponents(label.shape);
  label.shape = VoxelShape();
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    const std::uint64_t voxels = parts[i].CountVoxels();
    labels.push_back({ { label.value, label.name + "#" + std::to_string(i + 1), voxels, std::move(parts[i]) },
                       static_cast<std::int64_t>(i + 1),
                       record });
  }
}

std::string
Counted(std::uint64_t count, const std::string & one, const std::string & many)
{
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

/** The sum over all labels in words. */
std::vector<std::string>
Describe(const EditRecord & sum, const ShapeEditOptions & options)
{
  std::vector<std::string> notes;
  if (options.crop)
  {
    notes.push_back("crop " + CropText(*options.crop) + ": " + Counted(sum.voxelsCropped, "voxel", "voxels") +
                    " left out");
  }
  if (options.fillCavities)
  {
    notes.push_back(Counted(sum.cavitiesFilled, "cavity", "cavities") + " filled with " +
                    Counted(sum.voxelsAdded, "voxel", "voxels") + ", " +
                    Counted(sum.componentsJoined, "component", "components") + " in them joined to what is around");
  }
  if (options.minVoxels || options.largest)
  {
    notes.push_back(Counted(sum.componentsRemoved, "component", "components") + " removed, with " +
                    Counted(sum.voxelsRemoved, "voxel", "voxels"));
  }
  return notes;
}

} // namespace

CropRange
ParseCrop(std::string_view text)
{
  CropRange   crop;
  bool        good = std::count(text.begin(), text.end(), ',') == 2;
  std::size_t at = 0;
  for (std::size_t axis = 0; good && axis < 3; ++axis)
  {
    const std::size_t      comma = std::min(text.find(',', at), text.size());
    const std::string_view range = text.substr(at, comma - at);
    const std::size_t      colon = range.find(':');
    good = colon != std::string_view::npos;
    if (good)
    {
      const std::string_view end = range.substr(colon + 1);
      const auto             first = ParseIndex(range.substr(0, colon), 0);
      const auto             last = ParseIndex(end, 0);
      good = first && last && (end.empty() || *first < *last);
      crop.first[axis] = first.value_or(0);
      crop.end[axis] = last.value_or(0);
    }
    at = comma + 1;
  }
  if (!good)
  {
    throw UsageError("--crop " + std::string(text) +
                     ": expected i0:i1,j0:j1,k0:k1 with 0 <= i0 < i1, such as 0:64,:,10: (voxels i0 to i1 - 1)");
  }
  return crop;
}

EditedLabels
EditLabels(LabelVolume &            volume,
           const ShapeEditOptions & options,
           bool                     keepAll,
           const std::string &      where,
           const ProgressCallback & progress)
{
  EditedLabels result;
  result.options = options;
  std::vector<LabelShape> labels = std::exchange(volume.labels, {});
  if (!options.AreAsked())
  {
    for (LabelShape & label : labels)
    {
      result.labels.push_back({ std::move(label), 0, std::nullopt });
    }
    return result;
  }
  if (options.crop)
  {
    result.options.crop = Resolved(*options.crop, volume.geometry, where);
  }
  EditRecord               sum;
  std::vector<std::string> gone;
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    ReportProgress(progress, "editing", static_cast<double>(i) / static_cast<double>(labels.size()));
    LabelShape &     label = labels[i];
    const EditRecord record = EditShape(label.shape, result.options);
    sum.voxelsCropped += record.voxelsCropped;
    sum.cavitiesFilled += record.cavitiesFilled;
    sum.voxelsAdded += record.voxelsAdded;
    sum.componentsJoined += record.componentsJoined;
    sum.componentsRemoved += record.componentsRemoved;
    sum.voxelsRemoved += record.voxelsRemoved;
    if (label.shape.Box().size[0] == 0)
    {
      gone.push_back(LabelText(label.value, label.name));
      if (keepAll)
      {
        throw InputError(where + ": nothing is left of " + gone.back() +
                         " after cropping and removing components; ask for less, or for other --labels");
      }
      continue;
    }
    Append(std::move(label), record, options.splitComponents, result.labels);
  }
  if (result.labels.empty())
  {
    throw InputError(where + ": nothing is left of any label after cropping and removing components; ask for less");
  }
  result.notes = Describe(sum, result.options);
  for (const std::string & label : gone)
  {
    result.notes.push_back("nothing is left of " + label);
  }
  return result;
}

} // namespace voxelcore
