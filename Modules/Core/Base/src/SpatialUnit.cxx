#include "voxelcore/Base/SpatialUnit.h"

#include <cctype>

namespace voxelcore
{

std::string
UnitName(SpatialUnit unit)
{
  return unit == SpatialUnit::Voxels ? "voxel" : "mm";
}

std::optional<SpatialUnit>
UnitNamed(std::string_view name)
{
  return name == "mm"      ? std::optional(SpatialUnit::Millimetres)
         : name == "voxel" ? std::optional(SpatialUnit::Voxels)
                           : std::nullopt;
}

std::string
InUnit(std::string text, SpatialUnit unit)
{
  if (unit == SpatialUnit::Millimetres)
  {
    return text;
  }
  const auto isLetter = [&text](std::size_t at) {
    return at < text.size() && std::isalpha(static_cast<unsigned char>(text[at])) != 0;
  };
  for (std::size_t at = text.find("mm"); at != std::string::npos; at = text.find("mm", at + 2))
  {
    if (!(at > 0 && isLetter(at - 1)) && !isLetter(at + 2))
    {
      text.replace(at, 2, "vox");
    }
  }
  return text;
}

} // namespace voxelcore
