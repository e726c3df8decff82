#pragma once
// Zeiss LSM: TIFF of one page a slice, each followed by a thumbnail, and a block of its own that says what they are.
// itk::LSMImageIO takes its metres for millimetres, and thumbnails for slices, which it writes beyond its memory.

#include "TiffDescription.h"

#include <cstdint>
#include <filesystem>
#include <optional>

namespace voxelcore
{

struct LsmInfo
{
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  PageOrder     pages; ///< without thumbnails; channels are values of a pixel
  StatedSpacing spacing;
};

/** Nothing where the first page has no such block. \throws InputError for a damaged one, and for scans that are no
 *  stacks of slices */
std::optional<LsmInfo>
ReadLsmInfo(const std::filesystem::path & path, const TiffHandle & tiff);

} // namespace voxelcore
