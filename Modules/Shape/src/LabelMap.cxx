#include "voxelcore/LabelMap.h"

namespace voxelcore
{

std::string
LabelText(std::int64_t value, const std::string & name)
{
  return "label " + std::to_string(value) + " (" + name + ")";
}

} // namespace voxelcore
