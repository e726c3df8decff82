#pragma once
// TIFF pages as slices, through libtiff itself: it reads every layout and compression to the stored values, where
// itk::TIFFImageIO falls back to RGBA pictures for tiles and counts pages with 16 bits.

#include "voxelcore/Formats/ScanFile.h"
#include "voxelcore/Formats/StatedSpacing.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace voxelcore
{

/** What the pages of a file have in common, and where they lie. */
struct TiffPages
{
  std::uint32_t              width = 0;
  std::uint32_t              height = 0;
  std::uint16_t              bits = 8;       ///< a stored value; 1, 2 and 4 become bytes
  std::uint16_t              samples = 1;    ///< values a pixel
  std::uint16_t              component = 0;  ///< which of them is read
  bool                       planar = false; ///< each of them in strips or tiles of its own
  PixelType                  type = PixelType::UInt8;
  bool                       minIsWhite = false;
  bool                       lossy = false;
  bool                       isLsm = false;
  std::vector<std::uint64_t> offsets;                   ///< of the directory of each page to read, in the file
  std::uint64_t              frames = 1;                ///< of which options.volume chose one
  StatedSpacing              spacing;                   ///< as the first page states it
  bool                       channelsAreSlices = false; ///< ImageJ's name for them, and what they are taken for

  /** ImageJ's stacks above 4 GB: the file lists one page, behind whose values those of the others lie. */
  struct Behind
  {
    std::uint64_t from = 0; ///< in the file, of the first page
    std::uint64_t slices = 0;
    bool          swapBytes = false;
  };
  std::optional<Behind> behind{};

  std::uint64_t
  PageBytes() const
  {
    return std::uint64_t{ width } * height * PixelBytes(type);
  }
};

/** \throws InputError when the file is damaged, its pages are not alike, or hold no whole numbers; several values a
 *  pixel or channels need options.component, several frames options.volume. */
TiffPages
InspectTiff(const std::filesystem::path & path, const ReadOptions & options);

/** Whether both have slices of the same size and kind. */
bool
AreAlike(const TiffPages & a, const TiffPages & b);

/** The voxels (of the component chosen) of all pages, in this machine's byte order. */
std::unique_ptr<ByteStream>
OpenTiffPages(const std::filesystem::path & path, const TiffPages & pages);

/** Notes and type that pages bring with them. */
void
DescribeTiff(const TiffPages & pages, ScanFile & scan);

} // namespace voxelcore
