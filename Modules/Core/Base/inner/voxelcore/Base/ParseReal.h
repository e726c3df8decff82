#pragma once
// Numbers out of text, in one way for files and options.

#include <optional>
#include <string_view>

namespace voxelcore
{

/** The whole text as a number, with one sign at most; nothing where any character is left over, and where it is too
 *  large for a double. Too small to be told from 0 is 0. Takes inf and nan: who cannot use them refuses them. */
std::optional<double>
ParseReal(std::string_view text);

} // namespace voxelcore
