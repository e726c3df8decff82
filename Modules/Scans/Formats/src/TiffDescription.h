#pragma once
// What programs for microscopes write into the ImageDescription of a TIFF: which page is what, and the voxel size.

#include "voxelcore/Formats/StatedSpacing.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace voxelcore
{

class TiffHandle;

/** ImageJ and OME put channels and time points into the same row of pages as slices. */
struct PageOrder
{
  /** ImageJ shows no more channels at a time; with more of them, slices have been stored as channels. */
  static constexpr std::uint64_t mostChannels = 7;

  std::string   program{}; ///< "ImageJ" or "OME"; empty: pages are slices
  std::uint64_t channels = 1;
  std::uint64_t frames = 1;
  std::uint64_t images = 0;        ///< that the description speaks of; 0: it does not say
  std::string   fastest = "CZT";   ///< which changes from page to page, which next: channel, slice, frame
  bool          isPlain = true;    ///< pages follow each other in that order
  std::uint64_t volumesInFile = 1; ///< images of their own (OME)

  /** Of `pages`: each a channel, more of them than ImageJ shows. */
  bool
  AreChannelsSlices(std::size_t pages) const
  {
    return program == "ImageJ" && frames == 1 && channels > mostChannels && channels == pages;
  }
};

/** Reads the first lines "key=value" of ImageJ, or OME-XML; `samples` is how many values a pixel has. */
PageOrder
ReadPageOrder(const std::string & description, std::uint16_t samples);

/** Of all pages those of the channel that options.component names and the frame that options.volume names.
 *  \throws InputError when there are several and none was chosen, or the pages do not fit the description. */
std::vector<std::uint64_t>
ChoosePages(const std::filesystem::path &      path,
            const PageOrder &                  order,
            const std::vector<std::uint64_t> & pages,
            const ReadOptions &                options);

/** The voxel size, the first of these that is there:
 *  - ImageJ: "unit=", and with it XResolution and YResolution (pixels a unit) and "spacing=" between slices; "yunit="
 *    and "zunit=" where axes differ;
 *  - OME-XML: PhysicalSizeX, Y, Z of Pixels with their units, micrometres by default;
 *  - XResolution and YResolution in dots an inch or cm, unless it is one dot, or one of the resolutions that image
 *    programs write for screens and printers (72, 90, 96, 100, 120, 144, 150, 180, 200, 240, 300, 350, 360, 400, 600,
 *    720, 1200 or 2400 dots an inch, within 0.02 %). They say nothing about slices. */
StatedSpacing
ReadTiffSpacing(const TiffHandle & tiff, const std::string & description);

/** The lines by which ImageJ, and this reader, know the voxel size; XResolution and YResolution are to be pixels a
 *  mm. */
std::string
ImageJDescription(const ImageGeometry & geometry);

} // namespace voxelcore
