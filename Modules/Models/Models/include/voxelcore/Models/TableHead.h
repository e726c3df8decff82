#pragma once
// Columns of a .csv, and its first line.

#include "voxelcore/Base/SpatialUnit.h"

#include <optional>
#include <string>

namespace voxelcore
{

/** A column that is known when a table is written. */
struct TextColumn
{
  std::string name;
  std::string unit; ///< empty: none; "1": a share
  std::string meaning;
};

/** Whether columns are called "length [mm]", with lengths in this unit, or "length". */
using HeadUnits = std::optional<SpatialUnit>;

} // namespace voxelcore
