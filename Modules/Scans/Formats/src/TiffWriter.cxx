// Multi-page TIFF through libtiff; itk::TIFFImageIO writes whole numbers of 8 and 16 bits only.

#include "TiffDescription.h"
#include "voxelcore/Base/OutputFile.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Formats/VolumeWriters.h"

#include <tiffio.h>

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <exception>
#include <memory>
#include <string>
#include <vector>

namespace voxelcore
{
namespace
{

int
Silent(TIFF *, void *, const char *, const char *, va_list)
{
  return 1;
}

/** A file for libtiff, which loses the reason when one cannot be written, and through which nothing may be thrown. */
class TiffOutput
{
public:
  explicit TiffOutput(const std::filesystem::path & path)
    : m_Name(path.string())
    , m_File(path, true)
  {}

  TIFF *
  Open(const char * mode, TIFFOpenOptions * options)
  {
    return TIFFClientOpenExt(m_Name.c_str(), mode, this, Read, Write, Seek, Close, Size, nullptr, nullptr, options);
  }

  /** Throws what went wrong first, if anything did. */
  void
  Rethrow() const
  {
    if (m_Failure)
    {
      std::rethrow_exception(m_Failure);
    }
  }
  void
  Finish()
  {
    Rethrow();
    m_File.Finish();
  }

private:
  /** What `work` does; -1 once something has failed. */
  template <typename TWork>
  static tmsize_t
  Guarded(thandle_t handle, const TWork & work)
  {
    auto & self = *static_cast<TiffOutput *>(handle);
    if (!self.m_Failure)
    {
      try
      {
        return static_cast<tmsize_t>(work(self));
      }
      catch (...)
      {
        self.m_Failure = std::current_exception();
      }
    }
    return -1;
  }

  static tmsize_t
  Read(thandle_t handle, void * bytes, tmsize_t count)
  {
    return Guarded(handle, [&](TiffOutput & self) {
      self.m_File.MoveTo(self.m_Place);
      const std::size_t got = self.m_File.Read(bytes, static_cast<std::size_t>(count));
      self.m_Place += got;
      self.m_IsBehindLast = false;
      return got;
    });
  }
  static tmsize_t
  Write(thandle_t handle, void * bytes, tmsize_t count)
  {
    return Guarded(handle, [&](TiffOutput & self) {
      if (!self.m_IsBehindLast)
      {
        self.m_File.MoveTo(self.m_Place);
      }
      self.m_File.Write(bytes, static_cast<std::size_t>(count));
      self.m_IsBehindLast = true;
      self.m_Place += static_cast<std::uint64_t>(count);
      self.m_Size = std::max(self.m_Size, self.m_Place);
      return count;
    });
  }
  static toff_t
  Seek(thandle_t handle, toff_t offset, int from)
  {
    return static_cast<toff_t>(Guarded(handle, [&](TiffOutput & self) {
      const std::uint64_t place = offset + (from == SEEK_CUR   ? self.m_Place
                                            : from == SEEK_END ? self.m_Size
                                                               : std::uint64_t{ 0 });
      self.m_IsBehindLast = self.m_IsBehindLast && place == self.m_Place;
      self.m_Place = place;
      return place;
    }));
  }
  static int
  Close(thandle_t)
  {
    return 0;
  }
  static toff_t
  Size(thandle_t handle)
  {
    return static_cast<TiffOutput *>(handle)->m_Size;
  }

  std::string        m_Name;
  OutputFile         m_File;
  std::uint64_t      m_Place = 0;
  std::uint64_t      m_Size = 0;
  bool               m_IsBehindLast = true; ///< of what was written, as the file's own place is
  std::exception_ptr m_Failure;
};

} // namespace

void
WriteTiff(const std::filesystem::path & path, const VolumeToWrite & volume)
{
  const auto &    size = volume.geometry.size;
  const PixelType type = volume.type;
  TiffOutput      output(path);
  const auto      fail = [&]() {
    output.Rethrow(); // says why, where the system does
    throw Error("libtiff could not write all of it");
  };
  const auto        rowBytes = static_cast<std::size_t>(size[0]) * PixelBytes(type);
  const auto        pageBytes = rowBytes * static_cast<std::size_t>(size[1]);
  const auto        wholeBytes = pageBytes * static_cast<std::size_t>(size[2]);
  TIFFOpenOptions * options = TIFFOpenOptionsAlloc();
  TIFFOpenOptionsSetErrorHandlerExtR(options, Silent, nullptr);
  TIFFOpenOptionsSetWarningHandlerExtR(options, Silent, nullptr);
  std::unique_ptr<TIFF, decltype(&TIFFClose)> tiff(output.Open(wholeBytes > (1ULL << 31) ? "w8" : "w", options),
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
    TIFFSetField(t, TIFFTAG_SAMPLEFORMAT, IsFloat(type) ? SAMPLEFORMAT_IEEEFP : SAMPLEFORMAT_UINT);
    TIFFSetField(t, TIFFTAG_SAMPLESPERPIXEL, 1);
    TIFFSetField(t, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
    TIFFSetField(t, TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
    TIFFSetField(t, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
    TIFFSetField(t, TIFFTAG_COMPRESSION, volume.compress ? COMPRESSION_ADOBE_DEFLATE : COMPRESSION_NONE);
#ifdef TIFFTAG_DEFLATE_SUBCODEC
    if (volume.compress) // a libtiff that has libdeflate, too, would give other bytes than one that has not
    {
      TIFFSetField(t, TIFFTAG_DEFLATE_SUBCODEC, DEFLATE_SUBCODEC_ZLIB);
    }
#endif
    TIFFSetField(t, TIFFTAG_ROWSPERSTRIP, static_cast<std::uint32_t>(rowsPerStrip));
    TIFFSetField(t, TIFFTAG_RESOLUTIONUNIT, RESUNIT_NONE); // in the unit that the description names
    TIFFSetField(t, TIFFTAG_XRESOLUTION, 1 / volume.geometry.spacing[0]);
    TIFFSetField(t, TIFFTAG_YRESOLUTION, 1 / volume.geometry.spacing[1]);
    if (z == 0)
    {
      TIFFSetField(t, TIFFTAG_IMAGEDESCRIPTION, ImageJDescription(volume.geometry).c_str());
    }
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
  tiff.reset(); // may write, too
  output.Finish();
}

} // namespace voxelcore
