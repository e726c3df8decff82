#pragma once
// Chunks of Neuroglancer's precomputed volumes that several share a file ("sharded"), and their packing of labels.
// https://github.com/google/neuroglancer/tree/master/src/datasource/precomputed

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

namespace voxelcore
{

struct PrecomputedShards
{
  unsigned preshiftBits = 0;
  unsigned minishardBits = 0;
  unsigned shardBits = 0;
  bool     isHashed = false;      ///< by MurmurHash3, else by the number itself
  bool     isIndexPacked = false; ///< by gzip
  bool     areDataPacked = false;
};

/** The number of a chunk at a place in a grid: the bits of i, j and k in turns, as long as a side of the grid has
 *  some. */
std::uint64_t
MortonCode(const std::array<std::uint64_t, 3> & place, const std::array<std::uint64_t, 3> & grid);

/** The low 64 bits of MurmurHash3_x86_128 of a number's eight bytes, seed 0. */
std::uint64_t
MurmurHash(std::uint64_t number);

/** The file in which the chunk of a number lies, if it is anywhere. */
std::filesystem::path
ShardFile(const std::filesystem::path & folder, const PrecomputedShards & shards, std::uint64_t number);

/** The bytes of a chunk, packed as they may be; nothing where it is not there. \throws InputError when the shard is
 *  damaged */
std::optional<std::vector<std::byte>>
FromPrecomputedShard(const std::filesystem::path & folder, const PrecomputedShards & shards, std::uint64_t number);

/** What gzip packed, whatever it comes to. \throws InputError when it is damaged, or stands for more than `most`
 *  bytes */
std::vector<std::byte>
Gunzipped(const std::filesystem::path & file, const std::vector<std::byte> & packed, std::uint64_t most);

/** Labels of "compressed_segmentation", one channel: x fastest. `width`: bytes a value, 4 or 8.
 *  \throws InputError when it is damaged */
std::vector<std::byte>
UnpackedSegmentation(const std::filesystem::path &        file,
                     const std::vector<std::byte> &       packed,
                     const std::array<std::uint64_t, 3> & size,
                     const std::array<std::uint64_t, 3> & block,
                     std::size_t                          width);

} // namespace voxelcore
