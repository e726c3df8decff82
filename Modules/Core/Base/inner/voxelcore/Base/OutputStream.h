#pragma once
// A stream into an OutputFile, for what writes to streams. Streams and libraries lose the reason of a failure: it is
// kept.

#include "voxelcore/Base/OutputFile.h"

#include <exception>
#include <ostream>
#include <streambuf>

namespace voxelcore
{

/** A stream that goes bad where the file cannot be written; Finish then says why. */
class OutputStream : public std::ostream
{
public:
  explicit OutputStream(const std::filesystem::path & path)
    : std::ostream(nullptr)
    , m_Buffer(path)
  {
    rdbuf(&m_Buffer);
  }

  /** Completes the file.
   *  \throws OutputError of the first failure */
  void
  Finish()
  {
    m_Buffer.Finish();
  }

private:
  class Buffer : public std::streambuf
  {
  public:
    explicit Buffer(const std::filesystem::path & path)
      : m_File(path)
    {}

    void
    Finish()
    {
      if (m_Trouble)
      {
        std::rethrow_exception(m_Trouble);
      }
      m_File.Finish();
    }

  private:
    template <typename Work>
    bool
    Do(Work && work)
    {
      try
      {
        if (!m_Trouble)
        {
          work();
        }
      }
      catch (...)
      {
        m_Trouble = std::current_exception();
      }
      return !m_Trouble;
    }

    std::streamsize
    xsputn(const char * bytes, std::streamsize count) override
    {
      return Do([&] { m_File.Write(bytes, static_cast<std::size_t>(count)); }) ? count : 0;
    }
    int_type
    overflow(int_type character) override
    {
      const char byte = traits_type::to_char_type(character);
      return xsputn(&byte, 1) == 1 ? traits_type::not_eof(character) : traits_type::eof();
    }
    pos_type
    seekoff(off_type offset, std::ios_base::seekdir from, std::ios_base::openmode) override
    {
      if (m_Trouble || from == std::ios_base::end)
      {
        return { off_type(-1) };
      }
      const off_type base = from == std::ios_base::cur ? static_cast<off_type>(m_File.Place()) : 0;
      return offset == 0 && from == std::ios_base::cur ? pos_type(base) : seekpos(base + offset, std::ios_base::out);
    }
    pos_type
    seekpos(pos_type place, std::ios_base::openmode) override
    {
      return Do([&] { m_File.MoveTo(static_cast<std::uint64_t>(off_type(place))); }) ? place : pos_type(off_type(-1));
    }

    OutputFile         m_File;
    std::exception_ptr m_Trouble;
  };

  Buffer m_Buffer;
};

} // namespace voxelcore
