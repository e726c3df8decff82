#include "voxelcore/Jobs/StagedModel.h"

#include <algorithm>

namespace voxelcore
{

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
