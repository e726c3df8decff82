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
    "Skeletons: count places as found up to L apart, such as 1mm, where A's radius is less; surfaces: count as covered "
    "what lies within L of the other" },
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
