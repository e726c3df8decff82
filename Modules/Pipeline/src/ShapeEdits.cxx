#include "voxelcore/ShapeEdits.h"

#include "JobTools.h"
#include "voxelcore/Error.h"
#include "voxelcore/ShapeOperations.h"

#include <algorithm>
#include <utility>

namespace voxelcore
{

namespace
{

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
    labels.push_back(
      { { label.value, label.name + "#" + std::to_string(i + 1), voxels, std::move(parts[i]), label.color },
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

EditedLabels
EditLabels(LabelVolume &            volume,
           const ShapeEditOptions & options,
           bool                     keepAll,
           const std::string &      where,
           const ProgressCallback & progress)
{
  EditedLabels            result;
  std::vector<LabelShape> labels = std::exchange(volume.labels, {});
  if (!options.AreAsked())
  {
    for (LabelShape & label : labels)
    {
      result.labels.push_back({ std::move(label), 0, std::nullopt });
    }
    return result;
  }
  EditRecord               sum;
  std::vector<std::string> gone;
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    ReportProgress(progress, "editing", static_cast<double>(i) / static_cast<double>(labels.size()));
    LabelShape &     label = labels[i];
    const EditRecord record = EditShape(label.shape, options);
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
                         " after removing components; ask for less, or for other --labels");
      }
      continue;
    }
    Append(std::move(label), record, options.splitComponents, result.labels);
  }
  if (result.labels.empty())
  {
    throw InputError(where + ": nothing is left of any label after removing components; ask for less");
  }
  result.notes = Describe(sum, options);
  for (const std::string & label : gone)
  {
    result.notes.push_back("nothing is left of " + label);
  }
  return result;
}

} // namespace voxelcore
