#pragma once
// A folder of masks, one file a structure, as TotalSegmentator and others write them: one label map in layers.

#include "voxelcore/Formats/ScanFile.h"

#include <filesystem>
#include <vector>

namespace voxelcore
{

/** The volumes in a folder, by name; slices and DICOM files are none. */
std::vector<std::filesystem::path>
MaskPaths(const std::filesystem::path & folder);

/** Each file is a layer with one segment, called as the file; its value is its place by name, from 1 on. Of each file
 *  what is not 0 is in.
 *  \throws InputError where a file has another grid than the first, or two values besides 0 */
ScanFile
OpenMaskFolder(const std::filesystem::path & folder, const ReadOptions & options);

} // namespace voxelcore
