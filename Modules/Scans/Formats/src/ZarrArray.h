#pragma once
// Arrays of Zarr, versions 2 and 3, on a local disk: what their metadata say, and their chunks.
// https://zarr-specs.readthedocs.io

#include "voxelcore/Formats/FormatOpeners.h"
#include "voxelcore/Labels/StoredVoxels.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace voxelcore
{

/** What was done to the bytes of a chunk. */
enum class ZarrCodec : std::uint8_t
{
  Deflate, ///< gzip or zlib
  Bzip2,
  Zstd,
  Blosc,
  Crc32c
};

/** A regular grid of chunks. Numbers and sizes are in the array's order of axes, slowest first. */
struct ZarrArray
{
  std::filesystem::path                 folder;
  int                                   version = 2;
  std::vector<std::uint64_t>            shape;
  std::vector<std::uint64_t>            chunk;   ///< sides of a chunk
  std::vector<std::uint64_t>            strides; ///< values from one to the next within a chunk, along each axis
  PixelType                             type = PixelType::UInt8;
  bool                                  bigEndian = false;
  std::vector<ZarrCodec>                codecs; ///< in the order of packing
  std::optional<std::vector<std::byte>> fill;   ///< a value as it is stored, for chunks that are not there
  std::string                           prefix; ///< of a chunk's name
  std::string                           separator;

  /** Several chunks in one file, with an index: the chunks above are those within. */
  struct Shards
  {
    std::vector<std::uint64_t> chunks;       ///< in a shard, along each axis
    bool                       atEnd = true; ///< the index
    bool                       hasChecksum = true;
  };
  std::optional<Shards> shards;

  // Of other formats that hold chunks in a grid: how a chunk is read, unpacked, and where it lies.
  std::function<std::optional<std::vector<std::byte>>(const std::vector<std::uint64_t> & index)> readChunk{};
  std::function<std::filesystem::path(const std::vector<std::uint64_t> & index)>                 chunkFile{};

  std::uint64_t
  ChunkBytes() const;

  /** The file that holds a chunk; it need not be there. */
  std::filesystem::path
  ChunkFile(const std::vector<std::uint64_t> & index) const;
};

/** The metadata file of an array or group in this folder: `zarr.json`, `.zarray`, `.zattrs`, `.zgroup`; null JSON where
 *  it is not there. \throws InputError when it is damaged */
nlohmann::json
ReadZarrJson(const std::filesystem::path & file);

/** Whether a folder holds an array. */
bool
IsZarrArray(const std::filesystem::path & folder);

/** \throws InputError when there is none, or one that is damaged, packed by a codec that is not known here, or holds no
 *  numbers */
ZarrArray
ReadZarrArray(const std::filesystem::path & folder);

/** The values of a chunk, unpacked; nothing when it is not there. Takes as much memory as the chunk's metadata say, but
 *  no more than its file can stand for. `checkedShards`: files whose index is known to have its checksum; a shard
 *  that is checked here joins them. \throws InputError when it is damaged */
std::optional<std::vector<std::byte>>
ReadZarrChunk(const ZarrArray &                  array,
              const std::vector<std::uint64_t> & index,
              std::set<std::filesystem::path> &  checkedShards);

} // namespace voxelcore
