#pragma once
// The first line of a .csv.

#include "voxelcore/Base/SpatialUnit.h"

#include <optional>

namespace voxelcore
{

/** Whether columns are called "length [mm]", with lengths in this unit, or "length". */
using HeadUnits = std::optional<SpatialUnit>;

} // namespace voxelcore
