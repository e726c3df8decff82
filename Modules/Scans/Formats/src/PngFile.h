#pragma once
// PNG slices, through libpng: values as they are stored, without gamma, palettes or widening of small depths.

#include "voxelcore/Formats/ScanFile.h"

#include <cstdint>
#include <filesystem>
#include <memory>

namespace voxelcore
{

/** What the header of a slice says. */
struct PngPage
{
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  int           bits = 8;      ///< of a stored value; 1, 2 and 4 become bytes
  int           samples = 1;   ///< values a pixel
  int           component = 0; ///< which of them is read

  PixelType
  Type() const
  {
    return bits == 16 ? PixelType::UInt16 : PixelType::UInt8;
  }
  std::uint64_t
  PageBytes() const
  {
    return std::uint64_t{ width } * height * PixelBytes(Type());
  }
};

/** \throws InputError when the file is damaged, cannot hold what its header claims, or has a palette; several values a
 *  pixel need options.component. */
PngPage
InspectPng(const std::filesystem::path & path, const ReadOptions & options);

/** The voxels of the slice, in this machine's byte order. A slice that is not interlaced is read row by row, others
 *  as a whole. */
std::unique_ptr<ByteStream>
OpenPngPage(const std::filesystem::path & path, const ReadOptions & options);

} // namespace voxelcore
