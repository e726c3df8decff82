#pragma once
// libtiff's handle as an object.

#include "voxelcore/Base/SystemCalls.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Formats/ScanFile.h"

#include <tiffio.h>

#include <array>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <limits>

namespace voxelcore
{

/** A file opened with handlers of its own: libtiff prints nothing, and no global state is touched. It is read by
 *  calls of ours that note errors: of a page whose successor cannot be read, libtiff says that it is the last. */
class TiffHandle
{
public:
  explicit TiffHandle(const std::filesystem::path & path)
    : m_Path(path)
    , m_File(path)
  {
    m_SystemError = m_File.IsOpen() ? 0 : errno;
    std::error_code error;
    m_Size = std::filesystem::file_size(path, error);
    m_SystemError = m_SystemError == 0 && error ? error.value() : m_SystemError;
    TIFFOpenOptions * options = TIFFOpenOptionsAlloc();
    TIFFOpenOptionsSetErrorHandlerExtR(options, &TiffHandle::OnError, this);
    TIFFOpenOptionsSetWarningHandlerExtR(options, &TiffHandle::OnWarning, this);
    // m: no memory mapping, where a file cut short meanwhile would end the process.
    m_Tiff = m_SystemError != 0 ? nullptr
                                : TIFFClientOpenExt(path.string().c_str(),
                                                    "rm",
                                                    this,
                                                    Read,
                                                    Write,
                                                    Seek,
                                                    Close,
                                                    Size,
                                                    nullptr,
                                                    nullptr,
                                                    options);
    TIFFOpenOptionsFree(options);
    if (m_Tiff == nullptr)
    {
      RefuseDamaged("not a TIFF file");
    }
  }
  TiffHandle(const TiffHandle &) = delete;
  TiffHandle &
  operator=(const TiffHandle &) = delete;
  ~TiffHandle()
  {
    if (m_Tiff != nullptr)
    {
      TIFFClose(m_Tiff);
    }
  }

  TIFF *
  Get() const
  {
    return m_Tiff;
  }

  bool
  HasError() const
  {
    return m_SystemError != 0 || !m_Error.empty();
  }

  template <typename T>
  T
  Field(std::uint32_t tag, T otherwise) const
  {
    T value{};
    return TIFFGetFieldDefaulted(m_Tiff, tag, &value) == 1 ? value : otherwise;
  }

  std::string
  Description() const
  {
    const char * text = nullptr;
    return TIFFGetField(m_Tiff, TIFFTAG_IMAGEDESCRIPTION, &text) == 1 && text != nullptr ? text : "";
  }

  [[noreturn]] void
  RefuseDamaged(std::string_view what) const
  {
    if (m_SystemError != 0)
    {
      throw InputError(Text(m_Path.string(), ": cannot read: ", std::strerror(m_SystemError)));
    }
    RefuseInput(m_Path,
                m_Error.empty() ? std::string(what) : Text(what, " (", m_Error, ")"),
                "the file is damaged, truncated or of another kind: write it anew");
  }

private:
  static int
  OnError(TIFF *, void * self, const char *, const char * format, va_list arguments)
  {
    auto & error = static_cast<TiffHandle *>(self)->m_Error;
    if (error.empty())
    {
      std::array<char, 400> text{};
      (void)std::vsnprintf(text.data(), text.size(), format, arguments);
      error = Printable(text.data(), 120);
    }
    return 1;
  }
  static int
  OnWarning(TIFF * tiff, void * self, const char * module, const char * format, va_list arguments)
  {
    // libtiff replaces byte counts that do not fit by what should be there, and reads on into other data.
    if (std::strstr(format, "ByteCount") != nullptr)
    {
      OnError(tiff, self, module, format, arguments);
    }
    return 1;
  }

  static tmsize_t
  Read(thandle_t self, void * bytes, tmsize_t count)
  {
    auto &     handle = *static_cast<TiffHandle *>(self);
    const auto got = handle.m_File.Read(static_cast<std::byte *>(bytes), static_cast<std::size_t>(count));
    if (got < 0 && handle.m_SystemError == 0)
    {
      handle.m_SystemError = errno;
    }
    handle.m_Place += got > 0 ? static_cast<std::uint64_t>(got) : 0;
    return static_cast<tmsize_t>(got);
  }
  static tmsize_t
  Write(thandle_t, void *, tmsize_t)
  {
    return -1;
  }
  static toff_t
  Seek(thandle_t self, toff_t offset, int from)
  {
    auto &              handle = *static_cast<TiffHandle *>(self);
    const std::uint64_t start = from == SEEK_SET ? 0 : from == SEEK_CUR ? handle.m_Place : handle.m_Size;
    const std::uint64_t place = start + offset; // damaged files ask for places that no file has
    if (place > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()))
    {
      return static_cast<toff_t>(-1);
    }
    handle.m_File.MoveTo(place);
    handle.m_Place = place;
    return place;
  }
  static int
  Close(thandle_t)
  {
    return 0;
  }
  static toff_t
  Size(thandle_t self)
  {
    return static_cast<TiffHandle *>(self)->m_Size;
  }

  std::filesystem::path m_Path;
  SystemFile            m_File;
  std::uint64_t         m_Size = 0;
  std::uint64_t         m_Place = 0; ///< in the file
  int                   m_SystemError = 0;
  TIFF *                m_Tiff = nullptr;
  std::string           m_Error;
};

} // namespace voxelcore
