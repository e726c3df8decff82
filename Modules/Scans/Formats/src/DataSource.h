#pragma once
// What NRRD and MetaImage share: voxel data behind the header or in detached files, packed or as text.

#include "voxelcore/Formats/ScanFile.h"

#include <string>
#include <string_view>
#include <vector>

namespace voxelcore
{

struct DataSource
{
  std::vector<std::filesystem::path> files;         ///< one or more, each an equal share of the voxels
  std::uint64_t                      offset = 0;    ///< in the file where the data begin
  std::uint64_t                      lineSkip = 0;  ///< lines to skip from there
  std::int64_t                       byteSkip = 0;  ///< bytes (unpacked) to skip then; -1: the data end with the file
  bool                               ascii = false; ///< numbers as text
  Packing                            packing = Packing::Plain;
};

/** Checks that the files are there and may hold `bytes` of voxel data in all, and opens them as one stream.
 *  \throws InputError */
std::unique_ptr<ByteStream>
OpenData(const std::filesystem::path & headerPath, const DataSource & source, PixelType type, std::uint64_t bytes);

/** The most voxel bytes that the files may hold. \throws InputError when one is missing. */
std::uint64_t
LargestData(const DataSource & source, PixelType type);

/** The data files that a header names: one (relative to the header's folder), those of `list` when the text is LIST, or
 *  those that "name%03d.raw 1 20 1" stands for. \throws InputError when it names none or makes no sense. */
std::vector<std::filesystem::path>
FilesNamed(const std::filesystem::path & headerPath, std::string_view text, const std::vector<std::string> & list);

/** Warns of a data file that is not in the header's folder or below, links followed: a header of unknown origin could
 *  name any file of the user's, or come with a link to it. */
void
WarnOfFilesElsewhere(ScanFile & scan, const DataSource & source);

/** Voxels in `data` that a text in the manner of MetaImage describes. */
ScanFile
OpenMetaText(const std::filesystem::path & data, const std::filesystem::path & text, const ReadOptions & options);
/** Whether a file begins as such a text. */
bool
IsMetaText(const std::filesystem::path & path);

} // namespace voxelcore
