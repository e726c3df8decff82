#include "PrecomputedShard.h"

#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Formats/ByteStream.h"
#include "voxelcore/Formats/ScanFile.h"

#include <zlib.h>

#include <algorithm>
#include <cstring>

namespace voxelcore
{
namespace
{

using Bytes = std::vector<std::byte>;

[[noreturn]] void
RefuseShard(const std::filesystem::path & file, const std::string & what)
{
  RefuseInput(file, what, "the store is damaged: fetch or write it anew");
}

template <typename T>
T
Little(const std::byte * at)
{
  T value = 0;
  for (std::size_t i = sizeof(T); i-- > 0;)
  {
    value = static_cast<T>(value << 8U) | std::to_integer<T>(at[i]);
  }
  return value;
}

std::uint32_t
Turned(std::uint32_t value, unsigned bits)
{
  return value << bits | value >> (32U - bits);
}

/** Bytes `from` to `from + count` of a file of `size` bytes. */
Bytes
PartOfShard(const std::filesystem::path & file, std::uint64_t size, std::uint64_t from, std::uint64_t count)
{
  if (from > size || count > size - from)
  {
    RefuseShard(file, "its index leads beyond its end");
  }
  Bytes bytes(static_cast<std::size_t>(count));
  OpenBytes(file, from, Packing::Plain)->Read(bytes.data(), bytes.size());
  return bytes;
}

} // namespace

std::uint64_t
MortonCode(const std::array<std::uint64_t, 3> & place, const std::array<std::uint64_t, 3> & grid)
{
  std::uint64_t code = 0;
  unsigned      to = 0;
  for (unsigned bit = 0; bit < 32 && to < 64; ++bit)
  {
    for (std::size_t axis = 0; axis < 3 && to < 64; ++axis)
    {
      if (std::uint64_t{ 1 } << bit < grid[axis])
      {
        code |= (place[axis] >> bit & 1U) << to++;
      }
    }
  }
  return code;
}

std::uint64_t
MurmurHash(std::uint64_t number)
{
  // MurmurHash3_x86_128 of Austin Appleby, public domain; for a key of eight bytes, which is less than a block.
  constexpr std::uint32_t c1 = 0x239B961BU;
  constexpr std::uint32_t c2 = 0xAB0E9789U;
  constexpr std::uint32_t c3 = 0x38B34AE5U;
  std::uint32_t           h1 = 0;
  std::uint32_t           h2 = 0;
  std::uint32_t           h3 = 0;
  std::uint32_t           h4 = 0;
  h2 ^= Turned(static_cast<std::uint32_t>(number >> 32U) * c2, 16) * c3;
  h1 ^= Turned(static_cast<std::uint32_t>(number) * c1, 15) * c2;
  const auto mix = [](std::uint32_t h) {
    h ^= h >> 16U;
    h *= 0x85EBCA6BU;
    h ^= h >> 13U;
    h *= 0xC2B2AE35U;
    return h ^ h >> 16U;
  };
  for (std::uint32_t * h : { &h1, &h2, &h3, &h4 })
  {
    *h ^= 8U;
  }
  h1 += h2 + h3 + h4;
  h2 += h1;
  h3 += h1;
  h4 += h1;
  for (std::uint32_t * h : { &h1, &h2, &h3, &h4 })
  {
    *h = mix(*h);
  }
  h1 += h2 + h3 + h4;
  h2 += h1;
  return std::uint64_t{ h2 } << 32U | h1;
}

std::filesystem::path
ShardFile(const std::filesystem::path & folder, const PrecomputedShards & shards, std::uint64_t number)
{
  const std::uint64_t shifted = shards.preshiftBits < 64 ? number >> shards.preshiftBits : 0;
  const std::uint64_t hash = shards.isHashed ? MurmurHash(shifted) : shifted;
  const std::uint64_t behind = shards.minishardBits < 64 ? hash >> shards.minishardBits : 0;
  const std::uint64_t shard = shards.shardBits < 64 ? behind & ((std::uint64_t{ 1 } << shards.shardBits) - 1) : behind;
  std::string         name;
  for (unsigned digit = (shards.shardBits + 3) / 4; digit-- > 0;)
  {
    name += "0123456789abcdef"[shard >> (4 * digit) & 15U];
  }
  return folder / ((name.empty() ? "0" : name) + ".shard");
}

std::optional<Bytes>
FromPrecomputedShard(const std::filesystem::path & folder, const PrecomputedShards & shards, std::uint64_t number)
{
  const auto      file = ShardFile(folder, shards, number);
  std::error_code missing;
  if (!std::filesystem::exists(file, missing))
  {
    return std::nullopt;
  }
  const std::uint64_t size = FileSize(file);
  const std::uint64_t shifted = number >> shards.preshiftBits;
  const std::uint64_t hash = shards.isHashed ? MurmurHash(shifted) : shifted;
  const std::uint64_t minishard = hash & ((std::uint64_t{ 1 } << shards.minishardBits) - 1);
  const std::uint64_t indexBytes = std::uint64_t{ 16 } << shards.minishardBits;
  const Bytes         place = PartOfShard(file, size, 16 * minishard, 16);
  const auto          begin = Little<std::uint64_t>(place.data());
  const auto          end = Little<std::uint64_t>(place.data() + 8);
  if (begin == end)
  {
    return std::nullopt;
  }
  if (indexBytes > size || end < begin || end > size - indexBytes)
  {
    RefuseShard(file, "its index leads beyond its end");
  }
  Bytes index = PartOfShard(file, size, indexBytes + begin, end - begin);
  if (shards.isIndexPacked)
  {
    index = Gunzipped(file, index, LargestExpansion(Packing::Deflate) * index.size());
  }
  if (index.size() % 24 != 0)
  {
    RefuseShard(file, "an index is no table of three columns");
  }
  const std::size_t count = index.size() / 24;
  std::uint64_t     chunk = 0;
  std::uint64_t     from = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    chunk += Little<std::uint64_t>(index.data() + 8 * i);
    from += Little<std::uint64_t>(index.data() + 8 * (count + i));
    const auto length = Little<std::uint64_t>(index.data() + 8 * (2 * count + i));
    if (from > size - indexBytes || length > size - indexBytes - from)
    {
      RefuseShard(file, "an index leads beyond its end");
    }
    if (chunk == number)
    {
      return PartOfShard(file, size, indexBytes + from, length);
    }
    from += length;
  }
  return std::nullopt;
}

Bytes
Gunzipped(const std::filesystem::path & file, const Bytes & packed, std::uint64_t most)
{
  z_stream zlib{};
  if (inflateInit2(&zlib, 15 + 32) != Z_OK) // gzip or zlib by what is there
  {
    throw std::bad_alloc();
  }
  Bytes unpacked;
  zlib.next_in = reinterpret_cast<Bytef *>(const_cast<std::byte *>(packed.data()));
  zlib.avail_in = static_cast<uInt>(std::min<std::size_t>(packed.size(), UINT32_MAX));
  std::array<std::byte, 1U << 16> some{};
  int                             status = Z_OK;
  while (status == Z_OK && unpacked.size() <= most)
  {
    zlib.next_out = reinterpret_cast<Bytef *>(some.data());
    zlib.avail_out = static_cast<uInt>(some.size());
    status = inflate(&zlib, Z_NO_FLUSH);
    unpacked.insert(unpacked.end(), some.begin(), some.end() - static_cast<std::ptrdiff_t>(zlib.avail_out));
    if (status == Z_BUF_ERROR)
    {
      break;
    }
  }
  inflateEnd(&zlib);
  if (status != Z_STREAM_END || unpacked.size() > most)
  {
    RefuseShard(file, "a part does not unpack to its size by gzip");
  }
  return unpacked;
}

Bytes
UnpackedSegmentation(const std::filesystem::path &        file,
                     const Bytes &                        packed,
                     const std::array<std::uint64_t, 3> & size,
                     const std::array<std::uint64_t, 3> & block,
                     std::size_t                          width)
{
  constexpr std::size_t word = 4;
  const std::uint64_t   words = packed.size() / word;
  const auto            at = [&](std::uint64_t index) {
    if (index >= words)
    {
      RefuseShard(file, "a chunk of compressed_segmentation leads beyond its end");
    }
    return Little<std::uint32_t>(packed.data() + word * index);
  };
  const std::uint64_t          channel = at(0);
  std::array<std::uint64_t, 3> grid{};
  std::uint64_t                blocks = 1;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    grid[axis] = (size[axis] + block[axis] - 1) / block[axis];
    blocks *= grid[axis];
  }
  if (channel > words || 2 * blocks > words - channel) // before a chunk takes its memory
  {
    RefuseShard(file, "a chunk of compressed_segmentation is shorter than its list of blocks");
  }
  Bytes       values(static_cast<std::size_t>(size[0] * size[1] * size[2]) * width);
  std::byte * to = values.data();
  for (std::uint64_t z = 0; z < size[2]; ++z)
  {
    for (std::uint64_t y = 0; y < size[1]; ++y)
    {
      for (std::uint64_t x = 0; x < size[0]; ++x, to += width)
      {
        const std::uint64_t number = ((z / block[2]) * grid[1] + y / block[1]) * grid[0] + x / block[0];
        const std::uint32_t first = at(channel + 2 * number);
        const std::uint64_t table = channel + (first & 0xFFFFFFU);
        const unsigned      bits = first >> 24U;
        std::uint64_t       entry = 0;
        if (bits > 0)
        {
          if (bits > 32 || (bits & (bits - 1)) != 0)
          {
            RefuseShard(file, Text("a block of compressed_segmentation has ", bits, " bits a voxel"));
          }
          const std::uint64_t within = ((z % block[2]) * block[1] + y % block[1]) * block[0] + x % block[0];
          const std::uint64_t bit = within * bits;
          const std::uint32_t code = at(channel + at(channel + 2 * number + 1) + bit / 32);
          entry = code >> (bit % 32) & (bits < 32 ? (1U << bits) - 1U : ~0U);
        }
        for (std::size_t part = 0; part < width / word; ++part)
        {
          const std::uint64_t place = table + entry * (width / word) + part;
          (void)at(place);
          std::memcpy(to + part * word, packed.data() + word * place, word);
        }
      }
    }
  }
  return values;
}

} // namespace voxelcore
