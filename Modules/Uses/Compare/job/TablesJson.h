#pragma once
// The numbers of a comparison as JSON.

#include "voxelcore/Compare/CompareTables.h"

#include <nlohmann/json.hpp>

namespace voxelcore
{

/** An object with a list of objects for each table; null where nothing is. */
nlohmann::ordered_json
TablesAsJson(const std::vector<CompareTable> & tables);

} // namespace voxelcore
