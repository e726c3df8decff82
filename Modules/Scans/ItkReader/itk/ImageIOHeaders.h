#pragma once
// What ITK's ImageIOs leave out, or take for something else without a word, looked up in the file itself.

#include "ItkScan.h"

#include <filesystem>

namespace voxelcore::itkreader
{

/** Looks for what ITK must not see: a length in the header of MRC that the file does not have makes its reader free
 *  memory twice. \throws InputError */
void
CheckBeforeItk(const std::filesystem::path & path, ItkFormat format);

/** Looks into the header that ITK has read already: corrects `scan`, adds notes, or refuses.
 *  \throws InputError */
void
CheckHeader(const std::filesystem::path & path, ItkFormat format, ItkScan & scan);

} // namespace voxelcore::itkreader
