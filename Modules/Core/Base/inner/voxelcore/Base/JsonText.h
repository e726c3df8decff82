#pragma once
// JSON of others, before it is parsed.

#include <cstddef>
#include <string_view>

namespace voxelcore
{

/** The text; nothing, which no parser takes for JSON, where brackets are nested more than 256 deep or an object has
 *  more than `mostMembers`. Values are copied and written by recursion, which ends the stack, and an object that keeps
 *  its order is searched from its beginning for each member. */
std::string_view
PlainJson(std::string_view text, std::size_t mostMembers = 4096);

} // namespace voxelcore
