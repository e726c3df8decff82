#pragma once
// libtiff's handle as an object.

#include "voxelcore/ScanFile.h"
#include "voxelcore/TextFields.h"

#include <tiffio.h>

#include <array>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace voxelcore
{

/** A file opened with handlers of its own: libtiff prints nothing, and no global state is touched. It is read by calls
 *  of its own, too: where the system cannot read where the next page is, libtiff takes the page before for the last. */
class TiffHandle
{
public:
  explicit TiffHandle(const std::filesystem::path & path)
    : m_Path(path)
    , m_File{ open(path.c_str(), O_RDONLY | O_CLOEXEC) }
  {
    TIFFOpenOptions * options = TIFFOpenOptionsAlloc();
    TIFFOpenOptionsSetErrorHandlerExtR(options, &TiffHandle::OnError, this);
    TIFFOpenOptionsSetWarningHandlerExtR(options, &TiffHandle::OnWarning, this);
    // m: no memory mapping, where a file cut short meanwhile would end the process.
    m_Tiff = Noted(m_File.number) < 0
               ? nullptr
               : TIFFClientOpenExt(path.c_str(), "rm", this, Read, Write, Seek, Close, Size, nullptr, nullptr, options);
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

  template <typename Result>
  Result
  Noted(Result result)
  {
    if (result < 0 && m_SystemError == 0)
    {
      m_SystemError = errno;
    }
    return result;
  }
  static tmsize_t
  Read(thandle_t self, void * bytes, tmsize_t count)
  {
    auto &   handle = *static_cast<TiffHandle *>(self);
    tmsize_t done = 0;
    while (done < count)
    {
      const ssize_t now =
        read(handle.m_File.number, static_cast<char *>(bytes) + done, static_cast<std::size_t>(count - done));
      if (now < 0 && errno == EINTR)
      {
        continue;
      }
      if (handle.Noted(now) <= 0)
      {
        return now < 0 ? now : done;
      }
      done += now;
    }
    return done;
  }
  static tmsize_t
  Write(thandle_t, void *, tmsize_t)
  {
    return -1;
  }
  static toff_t
  Seek(thandle_t self, toff_t offset, int from)
  {
    return static_cast<toff_t>(lseek(static_cast<TiffHandle *>(self)->m_File.number, static_cast<off_t>(offset), from));
  }
  static int
  Close(thandle_t)
  {
    return 0;
  }
  static toff_t
  Size(thandle_t self)
  {
    auto &      handle = *static_cast<TiffHandle *>(self);
    struct stat status = {};
    return handle.Noted(fstat(handle.m_File.number, &status)) == 0 ? static_cast<toff_t>(status.st_size) : toff_t{ 0 };
  }

  struct File
  {
    int number;

    ~File()
    {
      if (number >= 0)
      {
        close(number);
      }
    }
  };

  std::filesystem::path m_Path;
  File                  m_File;
  int                   m_SystemError = 0;
  TIFF *                m_Tiff = nullptr;
  std::string           m_Error;
};

} // namespace voxelcore
