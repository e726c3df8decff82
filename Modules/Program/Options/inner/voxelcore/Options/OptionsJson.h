#pragma once
// Commands and options as JSON: for the page's forms, and for descriptions of the program in other forms
// (Applications/descriptors).

#include "voxelcore/Options/Command.h"

#include <span>
#include <string>

namespace voxelcore
{

/** {commands: [{name, description, footer}], options: [{name, flags, kind, placeholder, default, required, commands,
 *  description, group}]} */
std::string
OptionsJson(std::span<const Command> commands);

} // namespace voxelcore
