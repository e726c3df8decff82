#pragma once
// What the shell and `man` know of the program, all from the table behind its --help.

#include "voxelcore/Options/Command.h"

#include <string>
#include <string_view>
#include <vector>

namespace voxelcore
{

/** "-o" and "--output" of "-o,--output"; none for a positional argument. */
std::vector<std::string>
FlagsOf(const Parameter & parameter);

/** The words of a choice: "auto", "lattice", ... */
std::vector<std::string>
WordsOf(const Parameter & parameter);

/** voxelcore.1 */
std::string
ProgramManual();

/** voxelcore-<command>.1 */
std::string
CommandManual(const Command & command);

std::string
BashCompletion();

std::string
ZshCompletion();

} // namespace voxelcore
