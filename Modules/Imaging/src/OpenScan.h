#pragma once
// Whichever the format.

#include "voxelcore/ScanFile.h"

#include <filesystem>

namespace voxelcore
{

/** Opens a scan by its kind; what has no reader of ours, through the helper program. \throws InputError, UsageError */
ScanFile
OpenScan(const std::filesystem::path & path, const ReadOptions & options);

} // namespace voxelcore
