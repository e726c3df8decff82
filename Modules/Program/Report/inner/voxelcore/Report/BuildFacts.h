#pragma once
// What this build was made of, and what it can do.

#include <string>

namespace voxelcore
{

/** Which sources this was built from, as 16 hexadecimal digits: another number when a file differs that results are
 *  made by. */
std::string
SourceDigest();

} // namespace voxelcore
