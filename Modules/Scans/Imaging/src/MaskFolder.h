#pragma once
// A folder of masks, one file a structure, as TotalSegmentator and others write them: one label map in layers.

#include "voxelcore/Formats/ScanFile.h"

#include <filesystem>
#include <vector>

namespace voxelcore
{

/** The volumes in a folder without slices, by name; none of any other path. */
std::vector<std::filesystem::path>
MaskPaths(const std::filesystem::path & folder);

/** The masks of a folder. Each is a layer with one segment, called as the file; its value is its place by name, from 1
 *  on. Of each file what is not 0 is in.
 *  \throws InputError where a file has another grid than the first, or two values besides 0 */
ScanFile
OpenMaskFolder(const std::filesystem::path &              folder,
               const std::vector<std::filesystem::path> & masks,
               const ReadOptions &                        options);

} // namespace voxelcore
