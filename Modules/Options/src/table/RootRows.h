#pragma once
// Options of `roots` alone.

#include "CommandBits.h"

#include <array>

namespace voxelcore::table
{

inline constexpr auto kRootRows = std::to_array<Parameter>({
  { "up",
    "--up",
    Text,
    "auto|x+|x-|y+|y-|z+|z-",
    "auto",
    false,
    kRoots,
    "Direction that was up, along an axis of the scan's space (LPS); auto finds it by the stem" },
  { "stems",
    "--stems",
    Text,
    "N|auto",
    "1",
    false,
    kRoots,
    "Number of stems; auto counts those about as thick and high" },
  { "soil-depth",
    "--soil-depth",
    Real,
    "MM",
    "",
    false,
    kRoots,
    "Depth of the soil plane below the base of the stem; counts roots and whorls above and below it" },
  { "as-is",
    "--as-is",
    Flag,
    "",
    "",
    false,
    kRoots,
    "Do not clean the mask; without this it is mended, hollow roots (--fill-hollows, by a width found) and cavities "
    "are "
    "filled, and the largest piece is kept" },
  { "no-pictures", "--no-pictures", Flag, "", "", false, kRoots, "Leave out roots.png and roots.html" },
});

} // namespace voxelcore::table
