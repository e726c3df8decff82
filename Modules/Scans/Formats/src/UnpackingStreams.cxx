// Packed bytes of a file as a stream of what they stand for.

#include "PlainStream.h"
#include "voxelcore/Base/TextFields.h"

#include <zlib.h>
#ifdef VOXELCORE_BZIP2
#  include <bzlib.h>
#endif

#include <array>

namespace voxelcore
{
namespace
{

constexpr std::size_t kChunk = 256 * 1024;
// How much surplus data Finish() unpacks to reach the checksum; a gzip bomb must not keep us busy.
constexpr std::uint64_t kLongestSurplus = 64ULL << 20;

/** What unpacking streams share: a buffer of packed bytes. */
class UnpackingStream : public ByteStream
{
public:
  bool
  Finish() override
  {
    std::array<std::byte, 65536> surplus;
    std::uint64_t                left = 0;
    while (left < kLongestSurplus)
    {
      const std::size_t got = ReadSome(surplus.data(), surplus.size());
      left += got;
      if (got < surplus.size())
      {
        break;
      }
    }
    return left > 0;
  }

protected:
  UnpackingStream(const std::filesystem::path & path, std::uint64_t offset)
    : ByteStream(path)
    , m_Source(path, offset)
    , m_Packed(kChunk)
  {}

  /** Packed bytes into the buffer; 0 at the end of the file. */
  std::size_t
  Fill()
  {
    return m_Source.ReadSome(m_Packed.data(), m_Packed.size());
  }

  [[noreturn]] void
  RefuseTruncated() const
  {
    RefuseInput(m_Path, "compressed data end too early: the file is truncated", "fetch or write it anew");
  }

  [[noreturn]] void
  RefuseDamaged() const
  {
    RefuseInput(m_Path, "compressed data are damaged", "fetch or write it anew");
  }

  PlainStream            m_Source;
  std::vector<std::byte> m_Packed;
};

class InflateStream : public UnpackingStream
{
public:
  InflateStream(const std::filesystem::path & path, std::uint64_t offset)
    : UnpackingStream(path, offset)
  {
    // 15 + 32: windows up to 32 kB, gzip or zlib by what is there.
    if (inflateInit2(&m_Zlib, 15 + 32) != Z_OK)
    {
      throw std::bad_alloc();
    }
  }
  InflateStream(const InflateStream &) = delete;
  InflateStream &
  operator=(const InflateStream &) = delete;
  ~InflateStream() override
  {
    inflateEnd(&m_Zlib);
  }

  std::size_t
  ReadSome(std::byte * to, std::size_t count) override
  {
    std::size_t done = 0;
    while (done < count && !m_Ended)
    {
      if (m_Zlib.avail_in == 0)
      {
        m_Zlib.avail_in = static_cast<uInt>(Fill());
        m_Zlib.next_in = reinterpret_cast<Bytef *>(m_Packed.data());
        if (m_Zlib.avail_in == 0)
        {
          if (m_BetweenMembers)
          {
            m_Ended = true;
            break;
          }
          RefuseTruncated();
        }
      }
      if (m_BetweenMembers)
      {
        // Another member, or padding such as tape blocks have: gzip itself ignores the latter.
        if (*m_Zlib.next_in != 0x1F)
        {
          m_Ended = true;
          break;
        }
        inflateReset(&m_Zlib);
        m_BetweenMembers = false;
      }
      const auto room = static_cast<uInt>(std::min<std::size_t>(count - done, 1U << 30));
      m_Zlib.next_out = reinterpret_cast<Bytef *>(to + done);
      m_Zlib.avail_out = room;
      const int status = inflate(&m_Zlib, Z_NO_FLUSH);
      done += room - m_Zlib.avail_out;
      if (status == Z_STREAM_END)
      {
        m_BetweenMembers = true;
      }
      else if (status != Z_OK && status != Z_BUF_ERROR)
      {
        RefuseDamaged();
      }
    }
    return done;
  }

private:
  z_stream m_Zlib{};
  bool     m_BetweenMembers = false;
  bool     m_Ended = false;
};

#ifdef VOXELCORE_BZIP2
class Bzip2Stream : public UnpackingStream
{
public:
  Bzip2Stream(const std::filesystem::path & path, std::uint64_t offset)
    : UnpackingStream(path, offset)
  {
    Start();
  }
  Bzip2Stream(const Bzip2Stream &) = delete;
  Bzip2Stream &
  operator=(const Bzip2Stream &) = delete;
  ~Bzip2Stream() override
  {
    BZ2_bzDecompressEnd(&m_Bzip2);
  }

  std::size_t
  ReadSome(std::byte * to, std::size_t count) override
  {
    std::size_t done = 0;
    while (done < count && !m_Ended)
    {
      if (m_Bzip2.avail_in == 0)
      {
        m_Bzip2.avail_in = static_cast<unsigned>(Fill());
        m_Bzip2.next_in = reinterpret_cast<char *>(m_Packed.data());
        if (m_Bzip2.avail_in == 0)
        {
          if (m_BetweenMembers)
          {
            m_Ended = true;
            break;
          }
          RefuseTruncated();
        }
      }
      if (m_BetweenMembers)
      {
        if (*m_Bzip2.next_in != 'B')
        {
          m_Ended = true;
          break;
        }
        const bz_stream rest = m_Bzip2;
        BZ2_bzDecompressEnd(&m_Bzip2);
        Start();
        m_Bzip2.next_in = rest.next_in;
        m_Bzip2.avail_in = rest.avail_in;
        m_BetweenMembers = false;
      }
      const auto room = static_cast<unsigned>(std::min<std::size_t>(count - done, 1U << 30));
      m_Bzip2.next_out = reinterpret_cast<char *>(to + done);
      m_Bzip2.avail_out = room;
      const int status = BZ2_bzDecompress(&m_Bzip2);
      done += room - m_Bzip2.avail_out;
      if (status == BZ_STREAM_END)
      {
        m_BetweenMembers = true;
      }
      else if (status != BZ_OK)
      {
        RefuseDamaged();
      }
    }
    return done;
  }

private:
  void
  Start()
  {
    m_Bzip2 = bz_stream{};
    if (BZ2_bzDecompressInit(&m_Bzip2, 0, 0) != BZ_OK)
    {
      throw std::bad_alloc();
    }
  }

  bz_stream m_Bzip2{};
  bool      m_BetweenMembers = false;
  bool      m_Ended = false;
};
#endif

/** Two hexadecimal digits a byte, blanks ignored (an encoding of NRRD). */
class HexStream : public UnpackingStream
{
public:
  HexStream(const std::filesystem::path & path, std::uint64_t offset)
    : UnpackingStream(path, offset)
  {}

  std::size_t
  ReadSome(std::byte * to, std::size_t count) override
  {
    std::size_t done = 0;
    while (done < count)
    {
      const int high = Digit();
      if (high < 0)
      {
        break;
      }
      const int low = Digit();
      if (low < 0)
      {
        RefuseInput(m_Path, "hexadecimal data end in the middle of a byte", "fetch or write it anew");
      }
      to[done++] = static_cast<std::byte>(high * 16 + low);
    }
    return done;
  }

private:
  int
  Digit()
  {
    for (;;)
    {
      if (m_At == m_End)
      {
        m_At = 0;
        m_End = Fill();
        if (m_End == 0)
        {
          return -1;
        }
      }
      const char c = static_cast<char>(m_Packed[m_At++]);
      if (c >= '0' && c <= '9')
      {
        return c - '0';
      }
      if ((c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F'))
      {
        return (c | 0x20) - 'a' + 10;
      }
      if (std::string_view(" \t\r\n").find(c) == std::string_view::npos)
      {
        RefuseInput(m_Path, "something other than hexadecimal digits in hexadecimal data", "fetch or write it anew");
      }
    }
  }

  std::size_t m_At = 0;
  std::size_t m_End = 0;
};

} // namespace

std::unique_ptr<ByteStream>
OpenBytes(const std::filesystem::path & path, std::uint64_t offset, Packing packing)
{
  switch (packing)
  {
    case Packing::Plain:
      break;
    case Packing::Deflate:
      return std::make_unique<InflateStream>(path, offset);
    case Packing::Bzip2:
#ifdef VOXELCORE_BZIP2
      return std::make_unique<Bzip2Stream>(path, offset);
#else
      RefuseInput(path,
                  "compressed with bzip2, which this build cannot read",
                  "rebuild with libbz2-dev or save as gzip");
#endif
    case Packing::Hex:
      return std::make_unique<HexStream>(path, offset);
  }
  return std::make_unique<PlainStream>(path, offset);
}

} // namespace voxelcore
