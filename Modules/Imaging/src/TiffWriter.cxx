// Multi-page TIFF through libtiff; itk::TIFFImageIO writes whole numbers of 8 and 16 bits only.

#include "VolumeWriters.h"

#include <tiffio.h>

#include <algorithm>
#include <cstdarg>
#include <memory>

namespace voxelcore
{
namespace
{

int
Silent(TIFF *, void *, const char *, const char *, va_list)
{
  return 1;
}

} // namespace

void
WriteTiff(const std::filesystem::path & path, const VolumeToWrite & volume)
{
  const auto &      size = volume.geometry.size;
  const PixelType   type = volume.type;
  const auto        fail = []() { throw OutputError("libtiff could not write all of it"); };
  const auto        rowBytes = static_cast<std::size_t>(size[0]) * PixelBytes(type);
  const auto        pageBytes = rowBytes * static_cast<std::size_t>(size[1]);
  const auto        wholeBytes = pageBytes * static_cast<std::size_t>(size[2]);
  TIFFOpenOptions * options = TIFFOpenOptionsAlloc();
  TIFFOpenOptionsSetErrorHandlerExtR(options, Silent, nullptr);
  TIFFOpenOptionsSetWarningHandlerExtR(options, Silent, nullptr);
  const std::unique_ptr<TIFF, decltype(&TIFFClose)> tiff(
    TIFFOpenExt(path.c_str(), wholeBytes > (1ULL << 31) ? "w8" : "w", options),
    &TIFFClose);
  TIFFOpenOptionsFree(options);
  if (!tiff)
  {
    fail();
  }
  const std::size_t rowsPerStrip = std::clamp<std::size_t>((1U << 20) / rowBytes, 1, static_cast<std::size_t>(size[1]));
  for (std::int64_t z = 0; z < size[2]; ++z)
  {
    TIFF * t = tiff.get();
    TIFFSetField(t, TIFFTAG_IMAGEWIDTH, static_cast<std::uint32_t>(size[0]));
    TIFFSetField(t, TIFFTAG_IMAGELENGTH, static_cast<std::uint32_t>(size[1]));
    TIFFSetField(t, TIFFTAG_BITSPERSAMPLE, static_cast<int>(8 * PixelBytes(type)));
    TIFFSetField(t, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_UINT);
    TIFFSetField(t, TIFFTAG_SAMPLESPERPIXEL, 1);
    TIFFSetField(t, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
    TIFFSetField(t, TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
    TIFFSetField(t, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
    TIFFSetField(t, TIFFTAG_COMPRESSION, volume.compress ? COMPRESSION_ADOBE_DEFLATE : COMPRESSION_NONE);
    TIFFSetField(t, TIFFTAG_ROWSPERSTRIP, static_cast<std::uint32_t>(rowsPerStrip));
    const std::byte * page = volume.slice(z).data();
    std::uint32_t     strip = 0;
    for (std::size_t at = 0; at < pageBytes; at += rowsPerStrip * rowBytes)
    {
      const std::size_t now = std::min(rowsPerStrip * rowBytes, pageBytes - at);
      // libtiff may swap or predict in the buffer it is given.
      std::vector<std::byte> copy(page + at, page + at + now);
      if (TIFFWriteEncodedStrip(t, strip++, copy.data(), static_cast<tmsize_t>(now)) != static_cast<tmsize_t>(now))
      {
        fail();
      }
    }
    if (TIFFWriteDirectory(t) == 0)
    {
      fail();
    }
  }
}

} // namespace voxelcore
