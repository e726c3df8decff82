#include "voxelcore/Formats/FormatOpeners.h"

#include <blosc.h>
#include <png.h>
#include <zlib.h>
#include <zstd.h>
#ifdef VOXELCORE_TIFF
#  include <tiffio.h>
#endif
#ifdef VOXELCORE_BZIP2
#  include <bzlib.h>
#endif

namespace voxelcore
{
namespace
{

/** The first number with a dot in a library's own words, such as "LIBTIFF, Version 4.5.0\nCopyright ...". */
std::string
VersionIn(const std::string & text)
{
  const std::size_t begin = text.find_first_of("0123456789");
  return begin == std::string::npos ? "?" : text.substr(begin, text.find_first_not_of("0123456789.", begin) - begin);
}

} // namespace

std::vector<std::string>
FormatLibraries()
{
  std::vector<std::string> libraries{ "libpng " + VersionIn(png_get_libpng_ver(nullptr)),
                                      "zlib " + VersionIn(zlibVersion()),
                                      "blosc " + VersionIn(blosc_get_version_string()),
                                      "zstd " + VersionIn(ZSTD_versionString()) };
#ifdef VOXELCORE_TIFF
  libraries.insert(libraries.begin(), "libtiff " + VersionIn(TIFFGetVersion()));
#endif
#ifdef VOXELCORE_BZIP2
  libraries.push_back("bzip2 " + VersionIn(BZ2_bzlibVersion()));
#endif
  return libraries;
}

} // namespace voxelcore
