#pragma once
// The voxel data of a file as a stream of bytes: plain, inflated, or from several files. Voxels are worked on slab by
// slab as they come, so no reader ever allocates what a header merely claims.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

namespace voxelcore
{

class ByteStream
{
public:
  virtual ~ByteStream() = default;

  /** Up to `count` bytes; fewer only at the end of the data. \throws InputError when the data are damaged. */
  virtual std::size_t
  ReadSome(std::byte * to, std::size_t count) = 0;

  /** Exactly `count` bytes. \throws InputError when there are not as many. */
  void
  Read(std::byte * to, std::size_t count);

  /** Goes `count` bytes on. */
  virtual void
  Skip(std::uint64_t count);

  /** Tells that the `count` bytes `from` bytes on will be read, and of what lies between such pieces little, so that
   *  whoever reads a file ahead reads no more. It changes no byte. */
  virtual void
  Announce(std::uint64_t /*from*/, std::uint64_t /*count*/)
  {}

  /** To be called when all that is needed has been read: checks what checksum there is. Returns whether data were left
   *  over. \throws InputError when the end is missing or the checksum is wrong. */
  virtual bool
  Finish() = 0;

protected:
  explicit ByteStream(std::filesystem::path path)
    : m_Path(std::move(path))
  {}

  std::filesystem::path m_Path; ///< for messages
};

/** How bytes are packed in a file. */
enum class Packing : std::uint8_t
{
  Plain,
  Deflate, ///< gzip (any number of members) or zlib
  Bzip2,
  Hex
};

/** The most bytes that one byte of a file may stand for: what a header may claim at all. */
std::uint64_t
LargestExpansion(Packing packing);

/** Size of a regular file. \throws InputError when it is missing, no file, or unreadable. */
std::uint64_t
FileSize(const std::filesystem::path & path);

/** Opens a file at an offset (in the file as it lies on disk). \throws InputError when it cannot be opened. */
std::unique_ptr<ByteStream>
OpenBytes(const std::filesystem::path & path, std::uint64_t offset, Packing packing);

/** Deflate when the file begins like gzip, else Plain: names do not tell. */
Packing
DetectGzip(const std::filesystem::path & path);

/** Several files one after the other, each giving `bytesEach` bytes; opened when their turn comes. */
using StreamOpener = std::function<std::unique_ptr<ByteStream>(const std::filesystem::path &)>;
std::unique_ptr<ByteStream>
OpenParts(std::vector<std::filesystem::path> paths, std::uint64_t bytesEach, StreamOpener opener);

} // namespace voxelcore
