#pragma once
// The unit of a scan's places and lengths. A file that gives no voxel size has none but its voxels.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace voxelcore
{

enum class SpatialUnit : std::uint8_t
{
  Millimetres,
  Voxels
};

/** What files say (the field `Units`, "unit" in reports): "mm" or "voxel". */
std::string
UnitName(SpatialUnit unit);

/** The inverse. */
std::optional<SpatialUnit>
UnitNamed(std::string_view name);

/** A text or key that speaks of mm, said in `unit`: of voxels "area_mm2" becomes "area_vox2", "1.5 mm" "1.5 vox". An mm
 *  within a word stays. */
std::string
InUnit(std::string text, SpatialUnit unit);

/** JSON (of nlohmann) with all its keys said in `unit`. */
template <typename Json>
Json
KeysInUnit(const Json & json, SpatialUnit unit)
{
  if (unit == SpatialUnit::Millimetres || !json.is_structured())
  {
    return json;
  }
  Json named = json.is_array() ? Json::array() : Json::object();
  for (const auto & [key, value] : json.items())
  {
    if (json.is_array())
    {
      named.push_back(KeysInUnit(value, unit));
    }
    else
    {
      named[InUnit(key, unit)] = KeysInUnit(value, unit);
    }
  }
  return named;
}

/** The value under a key such as "area_mm2", whichever unit it is said in. Throws as json.at() does. */
template <typename Json>
const Json &
AtLength(const Json & json, const std::string & key)
{
  const std::string inVoxels = InUnit(key, SpatialUnit::Voxels);
  return json.at(json.contains(inVoxels) ? inVoxels : key);
}

} // namespace voxelcore
