#pragma once
// Options of `compare` alone.

#include "CommandBits.h"

#include <array>

namespace voxelcore::table
{

inline constexpr auto kCompareRows = std::to_array<Parameter>({
  { "near",
    "--near",
    Text,
    "L",
    "",
    false,
    kCompare,
    "Skeletons: take places as found no farther apart than L, such as 1mm, where A's radius is less; surfaces: the "
    "distance up to which one covers the other" },
  { "no-skeletons",
    "--no-skeletons",
    Flag,
    "",
    "",
    false,
    kCompare,
    "Masks: leave out what needs their skeletons: clDice, detected branches and length, loops that differ" },
});

} // namespace voxelcore::table
