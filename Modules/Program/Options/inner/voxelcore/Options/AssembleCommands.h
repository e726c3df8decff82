#pragma once
// What Commands() is made of.

#include "voxelcore/Options/Command.h"

#include <vector>

namespace voxelcore
{

/** In the order of their places, with the options that extensions and cases of batches give them. The commands speak of
 *  rows that are kept as long as the program runs. */
std::vector<Command>
AssembleCommands(std::span<const Command * const> commands, std::span<const Extension * const> extensions);

} // namespace voxelcore
