// Multi-page TIFF through libtiff; itk::TIFFImageIO writes whole numbers of 8 and 16 bits only.

#include "TiffDescription.h"
#include "voxelcore/Base/OutputFile.h"
#include "voxelcore/Base/TemporaryNames.h"
#include "voxelcore/Formats/VolumeWriters.h"

#include <tiffio.h>

#include <algorithm>
#include <cerrno>
#include <cstdarg>
#include <fcntl.h>
#include <memory>
#include <sys/stat.h>
#include <unistd.h>

namespace voxelcore
{
namespace
{

int
Silent(TIFF *, void *, const char *, const char *, va_list)
{
  return 1;
}

/** A file for libtiff, which loses the reason when one cannot be written. */
class TiffOutput
{
public:
  explicit TiffOutput(const std::filesystem::path & path)
    : m_Path(path)
    , m_Descriptor(open(path.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC | (WriterOf(path) ? O_EXCL : 0), 0666))
  {
    if (m_Descriptor < 0)
    {
      FailOutput(path, errno);
    }
  }
  TiffOutput(const TiffOutput &) = delete;
  TiffOutput &
  operator=(const TiffOutput &) = delete;
  ~TiffOutput()
  {
    if (m_Descriptor >= 0)
    {
      close(m_Descriptor);
    }
  }

  TIFF *
  Open(const char * mode, TIFFOpenOptions * options)
  {
    return TIFFClientOpenExt(m_Path.c_str(), mode, this, Read, Write, Seek, Close, Size, nullptr, nullptr, options);
  }

  /** Throws what went wrong first, if anything did. */
  void
  Finish()
  {
    const int descriptor = m_Descriptor;
    m_Descriptor = -1;
    if (close(descriptor) != 0 && m_Error == 0)
    {
      m_Error = errno;
    }
    if (m_Error != 0)
    {
      FailOutput(m_Path, m_Error);
    }
  }

private:
  static TiffOutput &
  Self(thandle_t handle)
  {
    return *static_cast<TiffOutput *>(handle);
  }
  template <typename Result>
  Result
  Noted(Result result)
  {
    if (result < 0 && m_Error == 0)
    {
      m_Error = errno;
    }
    return result;
  }
  static tmsize_t
  Read(thandle_t handle, void * bytes, tmsize_t count)
  {
    return Self(handle).Noted(read(Self(handle).m_Descriptor, bytes, static_cast<std::size_t>(count)));
  }
  static tmsize_t
  Write(thandle_t handle, void * bytes, tmsize_t count)
  {
    tmsize_t done = 0;
    while (done < count)
    {
      const ssize_t now = write(Self(handle).m_Descriptor,
                                static_cast<const char *>(bytes) + done,
                                static_cast<std::size_t>(count - done));
      if (now < 0 && errno == EINTR)
      {
        continue;
      }
      if (Self(handle).Noted(now) <= 0)
      {
        return -1;
      }
      done += now;
    }
    return done;
  }
  static toff_t
  Seek(thandle_t handle, toff_t offset, int from)
  {
    return static_cast<toff_t>(Self(handle).Noted(lseek(Self(handle).m_Descriptor, static_cast<off_t>(offset), from)));
  }
  static int
  Close(thandle_t)
  {
    return 0;
  }
  static toff_t
  Size(thandle_t handle)
  {
    struct stat status = {};
    return Self(handle).Noted(fstat(Self(handle).m_Descriptor, &status)) == 0 ? static_cast<toff_t>(status.st_size)
                                                                              : toff_t{ 0 };
  }

  std::filesystem::path m_Path;
  int                   m_Descriptor;
  int                   m_Error = 0;
};

} // namespace

void
WriteTiff(const std::filesystem::path & path, const VolumeToWrite & volume)
{
  const auto &    size = volume.geometry.size;
  const PixelType type = volume.type;
  TiffOutput      output(path);
  const auto      fail = [&]() {
    output.Finish(); // says why, where the system does
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
