#pragma once
// A scan opened, whichever its format.

#include "voxelcore/Formats/ScanFile.h"

#include <filesystem>

namespace voxelcore
{

/** By our own reader where there is one, else through the helper program. \throws InputError, UsageError */
ScanFile
OpenScan(const std::filesystem::path & path, const ReadOptions & options);

} // namespace voxelcore
