// The chunks of a Zarr array, unpacked.

#include "voxelcore/Formats/ByteStream.h"
#include "ZarrArray.h"
#include "ZarrMetadata.h"
#include "voxelcore/Base/TextFields.h"

#include <blosc.h>
#include <zlib.h>
#include <zstd.h>
#ifdef VOXELCORE_BZIP2
#  include <bzlib.h>
#endif

#include <array>
#include <cstring>
#include <set>

namespace voxelcore
{
namespace
{

using Bytes = std::vector<std::byte>;

// A byte of blosc or zstd can stand for more than one of gzip: runs of 128 kB in a few bytes.
constexpr std::uint64_t kLargestRun = 1U << 17;

[[noreturn]] void
RefuseChunk(const std::filesystem::path & file, const std::string & what)
{
  RefuseInput(file, Text("the chunk ", what), "the store is damaged: fetch or write it anew");
}

/** Room for `count` bytes unpacked of `packed`. \throws InputError where so few cannot stand for so many */
Bytes
RoomFor(const std::filesystem::path & file, std::uint64_t count, std::size_t packed, std::uint64_t expansion)
{
  if (count > expansion * packed)
  {
    RefuseChunk(file, Text("has ", packed, " bytes, which cannot stand for ", count));
  }
  return Bytes(static_cast<std::size_t>(count));
}

Bytes
Inflated(const std::filesystem::path & file, const Bytes & packed, std::uint64_t count)
{
  Bytes    to = RoomFor(file, count, packed.size(), LargestExpansion(Packing::Deflate));
  z_stream zlib{};
  if (inflateInit2(&zlib, 15 + 32) != Z_OK) // gzip or zlib by what is there
  {
    throw std::bad_alloc();
  }
  zlib.next_in = reinterpret_cast<Bytef *>(const_cast<std::byte *>(packed.data()));
  zlib.avail_in = static_cast<uInt>(packed.size());
  zlib.next_out = reinterpret_cast<Bytef *>(to.data());
  zlib.avail_out = static_cast<uInt>(to.size());
  const int  status = inflate(&zlib, Z_FINISH);
  const bool whole = status == Z_STREAM_END && zlib.avail_out == 0;
  inflateEnd(&zlib);
  if (!whole)
  {
    RefuseChunk(file, "does not unpack to its size by gzip or zlib");
  }
  return to;
}

#ifdef VOXELCORE_BZIP2
Bytes
Unbzipped(const std::filesystem::path & file, const Bytes & packed, std::uint64_t count)
{
  Bytes        to = RoomFor(file, count, packed.size(), LargestExpansion(Packing::Bzip2));
  unsigned int size = static_cast<unsigned int>(to.size());
  if (BZ2_bzBuffToBuffDecompress(reinterpret_cast<char *>(to.data()),
                                 &size,
                                 reinterpret_cast<char *>(const_cast<std::byte *>(packed.data())),
                                 static_cast<unsigned int>(packed.size()),
                                 0,
                                 0) != BZ_OK ||
      size != to.size())
  {
    RefuseChunk(file, "does not unpack to its size by bzip2");
  }
  return to;
}
#endif

Bytes
Unzstd(const std::filesystem::path & file, const Bytes & packed, std::uint64_t count)
{
  Bytes to = RoomFor(file, count, packed.size(), kLargestRun);
  if (ZSTD_decompress(to.data(), to.size(), packed.data(), packed.size()) != to.size())
  {
    RefuseChunk(file, "does not unpack to its size by zstd");
  }
  return to;
}

Bytes
Unblosc(const std::filesystem::path & file, const Bytes & packed, std::uint64_t count)
{
  std::size_t said = 0;
  if (blosc_cbuffer_validate(packed.data(), packed.size(), &said) != 0 || said != count)
  {
    RefuseChunk(file, "does not unpack to its size by blosc");
  }
  Bytes to = RoomFor(file, count, packed.size(), kLargestRun);
  // One thread: several scans may be read at once, and the reader is a thread of its own already.
  if (blosc_decompress_ctx(packed.data(), to.data(), to.size(), 1) != static_cast<int>(to.size()))
  {
    RefuseChunk(file, "is damaged (blosc)");
  }
  return to;
}

/** CRC-32C (Castagnoli), as RFC 3720 has it. */
std::uint32_t
Crc32c(const std::byte * bytes, std::size_t count)
{
  static const auto table = [] {
    std::array<std::uint32_t, 256> made{};
    for (std::uint32_t i = 0; i < 256; ++i)
    {
      made[i] = i;
      for (int bit = 0; bit < 8; ++bit)
      {
        made[i] = (made[i] >> 1U) ^ ((made[i] & 1U) != 0 ? 0x82F63B78U : 0U);
      }
    }
    return made;
  }();
  std::uint32_t sum = ~0U;
  for (std::size_t i = 0; i < count; ++i)
  {
    sum = table[(sum ^ std::to_integer<std::uint32_t>(bytes[i])) & 0xFFU] ^ (sum >> 8U);
  }
  return ~sum;
}

template <typename T>
T
LittleEndian(const std::byte * bytes)
{
  T value = 0;
  for (std::size_t i = sizeof(T); i-- > 0;)
  {
    value = static_cast<T>(value << 8U) | std::to_integer<T>(bytes[i]);
  }
  return value;
}

/** Takes off the sum at the end. */
void
TakeChecksum(const std::filesystem::path & file, Bytes & bytes)
{
  constexpr std::size_t length = 4;
  if (bytes.size() < length ||
      LittleEndian<std::uint32_t>(bytes.data() + bytes.size() - length) != Crc32c(bytes.data(), bytes.size() - length))
  {
    RefuseChunk(file, "has another checksum than it says");
  }
  bytes.resize(bytes.size() - length);
}

Bytes
ReadPart(const std::filesystem::path & file, std::uint64_t offset, std::uint64_t length)
{
  Bytes bytes(static_cast<std::size_t>(length));
  OpenBytes(file, offset, Packing::Plain)->Read(bytes.data(), bytes.size());
  return bytes;
}

/** The packed bytes of a chunk in a shard; nothing when the shard lacks it. */
std::optional<Bytes>
FromShard(const std::filesystem::path &      file,
          const ZarrArray &                  array,
          const std::vector<std::uint64_t> & index,
          std::set<std::filesystem::path> &  checked)
{
  constexpr std::uint64_t entry = 16;
  const auto &            shards = *array.shards;
  const std::uint64_t     size = FileSize(file);
  std::uint64_t           count = 1;
  std::uint64_t           at = 0;
  for (std::size_t a = 0; a < index.size(); ++a)
  {
    if (shards.chunks[a] > size / entry / count) // before a product passes 2^64
    {
      RefuseChunk(file, "is shorter than the index of a shard");
    }
    count *= shards.chunks[a];
    at = at * shards.chunks[a] + index[a] % shards.chunks[a];
  }
  const std::uint64_t indexBytes = entry * count + (shards.hasChecksum ? 4 : 0);
  if (indexBytes > size)
  {
    RefuseChunk(file, "is shorter than the index of a shard");
  }
  const std::uint64_t start = shards.atEnd ? size - indexBytes : 0;
  // Once for all chunks: the time would grow with their square.
  if (shards.hasChecksum && !checked.contains(file))
  {
    Bytes table = ReadPart(file, start, indexBytes);
    TakeChecksum(file, table);
    checked.insert(file);
  }
  const Bytes place = ReadPart(file, start + entry * at, entry);
  const auto  offset = LittleEndian<std::uint64_t>(place.data());
  const auto  length = LittleEndian<std::uint64_t>(place.data() + 8);
  if (offset == UINT64_MAX && length == UINT64_MAX)
  {
    return std::nullopt;
  }
  if (offset > size || length > size - offset)
  {
    RefuseChunk(file, "has an index that leads beyond its end");
  }
  return ReadPart(file, offset, length);
}

} // namespace

std::optional<Bytes>
ReadZarrChunk(const ZarrArray &                  array,
              const std::vector<std::uint64_t> & index,
              std::set<std::filesystem::path> &  checkedShards)
{
  if (array.readChunk)
  {
    return array.readChunk(index);
  }
  const auto      file = array.ChunkFile(index);
  std::error_code missing;
  if (!std::filesystem::exists(file, missing))
  {
    return std::nullopt;
  }
  RequireInStore(array.folder, file);
  Bytes bytes;
  if (array.shards)
  {
    auto packed = FromShard(file, array, index, checkedShards);
    if (!packed)
    {
      return std::nullopt;
    }
    bytes = std::move(*packed);
  }
  else
  {
    constexpr std::uint64_t most = std::uint64_t{ 1 } << 31;
    const std::uint64_t     size = FileSize(file);
    if (size > most)
    {
      RefuseChunk(file, "is a file of more than 2 GB");
    }
    bytes = ReadPart(file, 0, size);
  }
  for (std::size_t i = array.codecs.size(); i-- > 0;)
  {
    // Only a checksum may lie between one packing and the values.
    std::uint64_t count = array.ChunkBytes();
    for (std::size_t before = 0; before < i; ++before)
    {
      count += array.codecs[before] == ZarrCodec::Crc32c ? 4 : 0;
    }
    switch (array.codecs[i])
    {
      case ZarrCodec::Crc32c:
        TakeChecksum(file, bytes);
        break;
      case ZarrCodec::Deflate:
        bytes = Inflated(file, bytes, count);
        break;
      case ZarrCodec::Bzip2:
#ifdef VOXELCORE_BZIP2
        bytes = Unbzipped(file, bytes, count);
#endif
        break;
      case ZarrCodec::Zstd:
        bytes = Unzstd(file, bytes, count);
        break;
      case ZarrCodec::Blosc:
        bytes = Unblosc(file, bytes, count);
        break;
    }
  }
  if (bytes.size() != array.ChunkBytes())
  {
    RefuseChunk(file, Text("holds ", bytes.size(), " bytes of values, where ", array.ChunkBytes(), " belong"));
  }
  return bytes;
}

} // namespace voxelcore
