#pragma once
// Formats that are not read: what they are, and what makes of them something that is.

#include <filesystem>

namespace voxelcore
{

/** For a file of no kind that is read: told by its first bytes, else by its extension. \throws InputError, always: one
 *  line that says what it is and which program or option leads on */
[[noreturn]] void
RefuseForeign(const std::filesystem::path & path);

/** For a folder without slices. \throws InputError where it is a store or holds files of a kind known here */
void
RefuseForeignFolder(const std::filesystem::path & path);

} // namespace voxelcore
