#pragma once
// Files that are written packed.

#include "voxelcore/Base/OutputFile.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <new>
#include <span>
#include <string_view>
#include <vector>
#include <zlib.h>

namespace voxelcore
{

// Label volumes shrink to a hundredth at any level; the lower ones are several times faster.
inline constexpr int kPackingLevel = 4;

enum class Wrapping
{
  None,
  Zlib,
  Gzip
};

/** A file that may be packed. */
class PackedFile
{
public:
  PackedFile(const std::filesystem::path & path, Wrapping wrapping, int strategy = Z_DEFAULT_STRATEGY)
    : m_File(path)
    , m_Wrapped(wrapping != Wrapping::None)
  {
    if (m_Wrapped &&
        deflateInit2(&m_Zlib, kPackingLevel, Z_DEFLATED, wrapping == Wrapping::Gzip ? 15 + 16 : 15, 8, strategy) !=
          Z_OK)
    {
      throw std::bad_alloc();
    }
    if (wrapping == Wrapping::Gzip)
    {
      m_Header.os = 3; // as on Unix; left to itself, zlib names the system, and files differ
      deflateSetHeader(&m_Zlib, &m_Header);
    }
  }
  PackedFile(const PackedFile &) = delete;
  PackedFile &
  operator=(const PackedFile &) = delete;
  ~PackedFile()
  {
    if (m_Wrapped)
    {
      deflateEnd(&m_Zlib);
    }
  }

  /** As it is, in front of anything packed. */
  void
  WritePlain(std::string_view text)
  {
    Put(text.data(), text.size());
  }

  void
  Write(std::span<const std::byte> bytes)
  {
    constexpr std::size_t step = 1U << 26;
    for (std::size_t at = 0; at < bytes.size(); at += step)
    {
      const auto part = bytes.subspan(at, std::min(step, bytes.size() - at));
      m_Wrapped ? Deflate(part, Z_NO_FLUSH) : Put(part.data(), part.size());
    }
  }

  /** Must be called: only now is it known that everything found room. Returns the bytes in the file. */
  std::uint64_t
  Close()
  {
    if (m_Wrapped)
    {
      Deflate({}, Z_FINISH);
    }
    m_File.Finish();
    return m_Bytes;
  }

private:
  void
  Deflate(std::span<const std::byte> bytes, int flush)
  {
    m_Zlib.next_in = reinterpret_cast<Bytef *>(const_cast<std::byte *>(bytes.data()));
    m_Zlib.avail_in = static_cast<uInt>(bytes.size());
    do
    {
      m_Zlib.next_out = m_Packed.data();
      m_Zlib.avail_out = static_cast<uInt>(m_Packed.size());
      deflate(&m_Zlib, flush);
      Put(m_Packed.data(), m_Packed.size() - m_Zlib.avail_out);
    } while (m_Zlib.avail_out == 0);
  }

  void
  Put(const void * bytes, std::size_t count)
  {
    m_File.Write(bytes, count);
    m_Bytes += count;
  }

  OutputFile         m_File;
  bool               m_Wrapped;
  z_stream           m_Zlib{};
  gz_header          m_Header{};
  std::vector<Bytef> m_Packed = std::vector<Bytef>(1U << 18);
  std::uint64_t      m_Bytes = 0;
};

} // namespace voxelcore
