#pragma once
// libtiff's handle as an object.

#include "voxelcore/ScanFile.h"
#include "voxelcore/TextFields.h"

#include <tiffio.h>

#include <array>
#include <cstdarg>
#include <cstdio>
#include <cstring>

namespace voxelcore
{

/** A file opened with handlers of its own: libtiff prints nothing, and no global state is touched. */
class TiffHandle
{
public:
  explicit TiffHandle(const std::filesystem::path & path)
    : m_Path(path)
  {
    TIFFOpenOptions * options = TIFFOpenOptionsAlloc();
    TIFFOpenOptionsSetErrorHandlerExtR(options, &TiffHandle::OnError, this);
    TIFFOpenOptionsSetWarningHandlerExtR(options, &TiffHandle::OnWarning, this);
    // m: no memory mapping, where a file cut short meanwhile would end the process.
    m_Tiff = TIFFOpenExt(path.c_str(), "rm", options);
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
    return !m_Error.empty();
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
      std::vsnprintf(text.data(), text.size(), format, arguments);
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

  std::filesystem::path m_Path;
  TIFF *                m_Tiff = nullptr;
  std::string           m_Error;
};

} // namespace voxelcore
