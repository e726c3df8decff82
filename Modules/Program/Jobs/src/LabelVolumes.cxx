#include "voxelcore/Jobs/LabelVolumes.h"

namespace voxelcore
{

std::filesystem::path
ColumnsBeside(const std::filesystem::path & table)
{
  return table.parent_path() / (table.stem().string() + "_columns.json");
}

} // namespace voxelcore
