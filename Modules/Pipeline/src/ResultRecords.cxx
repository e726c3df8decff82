#include "voxelcore/ResultRecords.h"

#include <algorithm>
#include <utility>

namespace voxelcore
{

SkeletonPart
TakeSkeleton(CertifiedSkeleton skeleton, LabelRecord & record)
{
  SkeletonPart part = std::move(skeleton.skeleton);
  part.label = record.label;
  part.component = record.component;
  part.name = record.name;
  record.skeleton = { skeleton.topology, part.table.numbers, std::move(skeleton.cuts), {} };
  return part;
}

CertifiedShape
RecordedShape(const CoreReport & made, const LabelRecord & label)
{
  return { LabelText(label.label, label.name), label.shape, label.box, made.input.geometry };
}

void
WriteStagedModel(OutputTransaction &           transaction,
                 const std::filesystem::path & target,
                 const MedialModel &           model,
                 const ModelOptions &          options,
                 std::vector<std::string> &    notes)
{
  const ModelOmissions omitted = WriteModel(transaction.Stage(target), target, model, options);
  std::string          text;
  const auto           add = [&text](std::uint64_t count, const std::string & what) {
    if (count > 0)
    {
      text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + what;
    }
  };
  add(omitted.vertices, "isolated vertices left out");
  add(omitted.edges, "edges on no face left out");
  const bool split =
    std::any_of(model.parts.begin(), model.parts.end(), [](const ModelPart & part) { return part.component != 0; });
  add(omitted.labels, split ? "components merged into one" : "labels merged into one");
  if (!text.empty())
  {
    notes.push_back(target.string() + ": what this format cannot hold: " + text + " (.vtp holds everything)");
  }
}

} // namespace voxelcore
