#include "voxelcore/Jobs/LabelVolumes.h"

namespace voxelcore
{

std::filesystem::path
Beside(const std::filesystem::path & output, const std::string & what)
{
  const std::string name = output.filename().string();
  const std::size_t end = name.ends_with(".nii.gz") ? name.size() - 7 : name.rfind('.');
  return output.parent_path() / (name.substr(0, end) + what + name.substr(end));
}

std::filesystem::path
ColumnsBeside(const std::filesystem::path & table)
{
  return table.parent_path() / (table.stem().string() + "_columns.json");
}

} // namespace voxelcore
