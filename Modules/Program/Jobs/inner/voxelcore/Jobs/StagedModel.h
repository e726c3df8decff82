#pragma once
// A model as one of a job's outputs.

#include "voxelcore/Jobs/OutputTransaction.h"
#include "voxelcore/Models/MedialModel.h"

#include <filesystem>
#include <string>
#include <vector>

namespace voxelcore
{

/** Writes a model under its staged name; what the format could not hold is added to `notes`. */
void
WriteStagedModel(OutputTransaction &           transaction,
                 const std::filesystem::path & target,
                 const MedialModel &           model,
                 const ModelOptions &          options,
                 std::vector<std::string> &    notes);

} // namespace voxelcore
