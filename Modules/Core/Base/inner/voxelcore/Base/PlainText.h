#pragma once
// Text from outside that a terminal is to show as text.

#include <string>
#include <string_view>

namespace voxelcore
{

/** The text with a '?' for each character that a terminal, a page or a table would not show but act on: control
 *  characters (of both sets, C0 and C1), and those that turn, overrule or end the direction of writing, or a line
 *  (U+061C, U+200E, U+200F, U+2028 to U+202E, U+2066 to U+2069): with U+202E a name reads as another. UTF-8.
 *  `keepsLines`: line ends and tabs stay. */
std::string
PlainText(std::string_view text, bool keepsLines = false);

} // namespace voxelcore
