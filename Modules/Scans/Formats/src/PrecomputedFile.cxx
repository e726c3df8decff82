// Neuroglancer's precomputed volumes in a local folder: `info`, and a folder of chunks for each resolution. A chunk is
// a part of the volume with x fastest, so that a volume is an array of Zarr's with the axes k, j, i.

#include "PrecomputedShard.h"
#include "ZarrMetadata.h"
#include "ZarrStream.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Formats/FormatOpeners.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>

namespace voxelcore
{
namespace
{

using Json = nlohmann::json;
namespace fs = std::filesystem;

using Triple = std::array<std::uint64_t, 3>; ///< along x, y, z

/** One resolution. */
struct Scale
{
  fs::path                         folder;
  PixelType                        type = PixelType::UInt8;
  Triple                           size{};
  Triple                           chunk{};
  std::array<std::int64_t, 3>      offset{}; ///< of the first voxel
  Vector3                          nanometres{};
  std::optional<Triple>            block; ///< of compressed_segmentation; none: raw
  std::optional<PrecomputedShards> shards;
  std::size_t                      count = 1; ///< of resolutions
  std::string                      properties;

  Triple
  Grid() const
  {
    Triple grid{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      grid[axis] = (size[axis] + chunk[axis] - 1) / chunk[axis];
    }
    return grid;
  }
};

[[noreturn]] void
RefusePrecomputed(const fs::path & path, const std::string & what)
{
  RefuseInput(path, what, "the store is damaged or not written to the end: write it anew");
}

Triple
ReadTriple(const fs::path & folder, const Json & json, const char * key)
{
  const auto sides = Sides(folder, json, key);
  if (sides.size() != 3)
  {
    RefusePrecomputed(folder, Text("its info has a '", key, "' that is not three numbers"));
  }
  return { sides[0], sides[1], sides[2] };
}

unsigned
ReadBits(const fs::path & folder, const Json & json, const char * key, unsigned most)
{
  const Json & value = Member(folder, json, key);
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > most)
  {
    RefusePrecomputed(folder, Text("its info has a '", key, "' that is no number of bits"));
  }
  return value.get<unsigned>();
}

PrecomputedShards
ReadSharding(const fs::path & folder, const Json & json)
{
  PrecomputedShards shards;
  shards.preshiftBits = ReadBits(folder, json, "preshift_bits", 63);
  shards.minishardBits = ReadBits(folder, json, "minishard_bits", 32);
  shards.shardBits = ReadBits(folder, json, "shard_bits", 64);
  const auto packed = [&](const char * key) { return json.contains(key) && Word(folder, json, key) == "gzip"; };
  shards.isIndexPacked = packed("minishard_index_encoding");
  shards.areDataPacked = packed("data_encoding");
  const std::string hash = Word(folder, json, "hash");
  shards.isHashed = hash == "murmurhash3_x86_128";
  if (!shards.isHashed && hash != "identity")
  {
    RefuseInput(folder, Text("shards by the hash '", Printable(hash, 30), "'"), "write it unsharded");
  }
  return shards;
}

Scale
ReadScale(const fs::path & folder, const ReadOptions & options)
{
  const Json   info = ReadZarrJson(folder / "info");
  const Json   none = Json::array();
  const Json & scales = info.contains("scales") ? info.at("scales") : none;
  if (!scales.is_array() || scales.empty())
  {
    RefusePrecomputed(folder, "its info has no scales");
  }
  const auto level = options.level.value_or(0);
  if (level < 0 || static_cast<std::size_t>(level) >= scales.size())
  {
    throw UsageError(Text("--level ", level, ": ", folder.string(), " has levels 0 to ", scales.size() - 1));
  }
  const Json & json = scales.at(static_cast<std::size_t>(level));
  Scale        scale;
  scale.count = scales.size();
  scale.folder = (folder / Word(folder, json, "key")).lexically_normal();
  scale.type = ZarrTypeOf(folder, LowerCase(Word(folder, info, "data_type")));
  const std::uint64_t channels = info.value("num_channels", std::uint64_t{ 1 });
  if (channels != 1)
  {
    RefuseInput(folder, Text("an image of ", channels, " channels"), "save the one with the labels by itself");
  }
  scale.size = ReadTriple(folder, json, "size");
  const Json & chunks = Member(folder, json, "chunk_sizes");
  if (!chunks.is_array() || chunks.empty())
  {
    RefusePrecomputed(folder, "its info has no chunk_sizes");
  }
  scale.chunk = ReadTriple(folder, Json{ { "chunk_sizes", chunks.at(0) } }, "chunk_sizes");
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    scale.chunk[axis] = std::min(scale.chunk[axis], scale.size[axis]);
    scale.nanometres[axis] = Member(folder, json, "resolution").at(axis).get<double>();
    scale.offset[axis] = json.contains("voxel_offset") ? json.at("voxel_offset").at(axis).get<std::int64_t>() : 0;
    if (!(scale.nanometres[axis] > 0) || !std::isfinite(scale.nanometres[axis]) ||
        std::abs(scale.offset[axis]) > std::int64_t{ 1 } << 40)
    {
      RefusePrecomputed(folder, "its info has a resolution or voxel_offset that cannot be");
    }
  }
  const std::string encoding = Word(folder, json, "encoding");
  if (encoding == "compressed_segmentation")
  {
    scale.block = ReadTriple(folder, json, "compressed_segmentation_block_size");
    if (PixelBytes(scale.type) != 4 && PixelBytes(scale.type) != 8)
    {
      RefusePrecomputed(folder, "compressed_segmentation of values that are neither uint32 nor uint64");
    }
  }
  else if (encoding != "raw")
  {
    RefuseInput(folder,
                Text("chunks in the encoding '", Printable(encoding, 30), "'"),
                "write it with the encoding raw or compressed_segmentation, with cloud-volume for instance");
  }
  if (json.contains("sharding") && !json.at("sharding").is_null())
  {
    scale.shards = ReadSharding(folder, json.at("sharding"));
  }
  scale.properties = info.value("segment_properties", std::string());
  return scale;
}

/** First and end along x, y, z, as in a chunk's name. */
fs::path
PrecomputedChunkPath(const Scale & scale, const Triple & place)
{
  std::string name;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto first = place[axis] * scale.chunk[axis];
    const auto end = std::min(first + scale.chunk[axis], scale.size[axis]);
    name += Text(axis > 0 ? "_" : "",
                 scale.offset[axis] + static_cast<std::int64_t>(first),
                 "-",
                 scale.offset[axis] + static_cast<std::int64_t>(end));
  }
  return scale.folder / name;
}

/** Of a chunk, the file that is there, also with an ending that tells how it is packed. */
fs::path
ChunkFileOf(const Scale & scale, const Triple & place)
{
  if (scale.shards)
  {
    return ShardFile(scale.folder, *scale.shards, MortonCode(place, scale.Grid()));
  }
  const fs::path  plain = PrecomputedChunkPath(scale, place);
  std::error_code ignored;
  const fs::path  packed = plain.string() + ".gz";
  return !fs::exists(plain, ignored) && fs::exists(packed, ignored) ? packed : plain;
}

/** The voxels of a chunk, filled up to the size of inner ones; nothing where it is not there. */
std::optional<std::vector<std::byte>>
ReadPrecomputedChunk(const Scale & scale, const Triple & place)
{
  const fs::path  file = ChunkFileOf(scale, place);
  std::error_code missing;
  if (!fs::exists(file, missing))
  {
    return std::nullopt;
  }
  RequireInStore(scale.folder, file);
  Triple        size{};
  std::uint64_t count = PixelBytes(scale.type);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    size[axis] = std::min(scale.chunk[axis], scale.size[axis] - place[axis] * scale.chunk[axis]);
    count *= size[axis];
  }
  std::vector<std::byte> bytes;
  if (scale.shards)
  {
    auto found = FromPrecomputedShard(scale.folder, *scale.shards, MortonCode(place, scale.Grid()));
    if (!found)
    {
      return std::nullopt;
    }
    bytes = std::move(*found);
  }
  else
  {
    constexpr std::uint64_t most = std::uint64_t{ 1 } << 31;
    if (FileSize(file) > most)
    {
      RefusePrecomputed(file, "a chunk of more than 2 GB");
    }
    bytes.resize(static_cast<std::size_t>(FileSize(file)));
    OpenBytes(file, 0, Packing::Plain)->Read(bytes.data(), bytes.size());
  }
  // Raw values may begin like gzip; what is as long as they are is not packed.
  const bool isGzip = bytes.size() > 2 && bytes[0] == std::byte{ 0x1F } && bytes[1] == std::byte{ 0x8B };
  if ((scale.shards ? scale.shards->areDataPacked : isGzip) && (scale.block || bytes.size() != count))
  {
    bytes = Gunzipped(file, bytes, std::min(LargestExpansion(Packing::Deflate) * bytes.size(), 3 * count + (1U << 20)));
  }
  if (scale.block)
  {
    bytes = UnpackedSegmentation(file, bytes, size, *scale.block, PixelBytes(scale.type));
  }
  if (bytes.size() != count)
  {
    RefusePrecomputed(file, Text("a chunk of ", bytes.size(), " bytes, where ", count, " belong"));
  }
  if (size == scale.chunk)
  {
    return bytes;
  }
  // At the end of the volume chunks are cut; an array's are not.
  const std::size_t      row = size[0] * PixelBytes(scale.type);
  const std::size_t      whole = scale.chunk[0] * PixelBytes(scale.type);
  std::vector<std::byte> filled(whole * scale.chunk[1] * scale.chunk[2]);
  for (std::uint64_t z = 0; z < size[2]; ++z)
  {
    for (std::uint64_t y = 0; y < size[1]; ++y)
    {
      std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>((z * size[1] + y) * row),
                  row,
                  filled.begin() + static_cast<std::ptrdiff_t>((z * scale.chunk[1] + y) * whole));
    }
  }
  return filled;
}

/** The names of segments, from the folder that info names. */
std::map<std::int64_t, ListedLabel>
ReadProperties(const fs::path & folder, const Scale & scale)
{
  std::map<std::int64_t, ListedLabel> labels;
  const Json properties = scale.properties.empty() ? Json() : ReadZarrJson(folder / scale.properties / "info");
  if (!properties.is_object() || !properties.contains("inline"))
  {
    return labels;
  }
  const Json & list = properties.at("inline");
  const Json & ids = list.at("ids");
  for (const Json & property : list.at("properties"))
  {
    if (property.value("type", "") != "label" || property.at("values").size() != ids.size())
    {
      continue;
    }
    for (std::size_t i = 0; i < ids.size(); ++i)
    {
      if (const auto id = ParseInteger(ids.at(i).get<std::string>()))
      {
        labels[*id].name = Printable(property.at("values").at(i).get<std::string>(), 200);
      }
    }
  }
  return labels;
}

ZarrVolume
AsZarr(const Scale & scale)
{
  ZarrVolume  volume;
  ZarrArray & array = volume.image.array;
  array.folder = scale.folder;
  array.shape = { scale.size[2], scale.size[1], scale.size[0] };
  array.chunk = { scale.chunk[2], scale.chunk[1], scale.chunk[0] };
  array.strides = { scale.chunk[1] * scale.chunk[0], scale.chunk[0], 1 };
  array.type = scale.type;
  array.fill = std::vector<std::byte>(PixelBytes(scale.type));
  array.readChunk = [scale](const std::vector<std::uint64_t> & at) {
    return ReadPrecomputedChunk(scale, { at[2], at[1], at[0] });
  };
  array.chunkFile = [scale](const std::vector<std::uint64_t> & at) {
    return ChunkFileOf(scale, { at[2], at[1], at[0] });
  };
  volume.image.spatial = { 0, 1, 2 };
  volume.place = { 0, 0, 0 };
  return volume;
}

/** What json throws of info of another kind than it should be. */
template <typename Work>
auto
GuardedInfo(const fs::path & path, const Work & work)
{
  try
  {
    return work();
  }
  catch (const Json::exception &)
  {
    RefusePrecomputed(path, "its info holds something of another type than it should");
  }
}

} // namespace

bool
IsPrecomputed(const fs::path & folder)
{
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored) || !fs::is_regular_file(folder / "info", ignored))
  {
    return false;
  }
  // Of other folders a file of that name is none of ours to refuse.
  std::string begin(4096, '\0');
  begin.resize(
    OpenBytes(folder / "info", 0, Packing::Plain)->ReadSome(reinterpret_cast<std::byte *>(begin.data()), begin.size()));
  return begin.find("\"scales\"") != std::string::npos ||
         begin.find("neuroglancer_multiscale_volume") != std::string::npos;
}

std::vector<fs::path>
PrecomputedFiles(const fs::path & path, const ReadOptions & options)
{
  return GuardedInfo(path, [&] {
    const Scale           scale = ReadScale(path, options);
    std::vector<fs::path> files{ path / "info" };
    const CropRange       part = ResolveCrop(options.crop,
                                       { static_cast<std::int64_t>(scale.size[0]),
                                               static_cast<std::int64_t>(scale.size[1]),
                                               static_cast<std::int64_t>(scale.size[2]) },
                                       path);
    const ZarrVolume      volume = AsZarr(scale);
    RequireSomeZarrChunks(path, volume, part);
    ZarrGrid(volume.image, part).Each([&](const ZarrTriple & at) {
      const auto      file = volume.image.array.ChunkFile(volume.ChunkIndex(at));
      std::error_code ignored;
      if (fs::is_regular_file(file, ignored))
      {
        files.push_back(file);
      }
      return true;
    });
    std::sort(files.begin(), files.end());
    files.erase(std::unique(files.begin(), files.end()), files.end());
    return files;
  });
}

ScanFile
OpenPrecomputed(const fs::path & path, const ReadOptions & options)
{
  return GuardedInfo(path, [&] {
    const Scale scale = ReadScale(path, options);
    ScanFile    scan;
    scan.path = path;
    scan.format = "Neuroglancer precomputed";
    scan.type = scale.type;
    Vector3 spacing{};
    Vector3 origin{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      scan.geometry.size[axis] = static_cast<std::int64_t>(scale.size[axis]);
      spacing[axis] = scale.nanometres[axis] / 1e6;
      // A voxel lies between its number and the next; its place is its middle.
      origin[axis] = (static_cast<double>(scale.offset[axis]) + 0.5) * spacing[axis];
    }
    CheckSize(path, scan.geometry.size, PixelBytes(scan.type), UINT64_MAX);
    ChooseVolume(path, 1, options);
    ChooseComponent(path, 1, "volume", options);
    scan.swapBytes = std::endian::native == std::endian::big;
    if (scale.count > 1)
    {
      scan.notes.push_back(Text("level ", options.level.value_or(0), " of ", scale.count, " resolutions"));
    }
    scan.notes.push_back("the file names no anatomical space: its axes are taken as LPS");
    scan.listed = ReadProperties(path, scale);
    const CropRange part = ResolveCrop(options.crop, scan.geometry.size, path);
    ZarrVolume      volume = AsZarr(scale);
    RequireSomeZarrChunks(path, volume, part);
    SetGeometry(scan, { { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } }, spacing, origin, options);
    scan.voxels = std::make_unique<ZarrStream>(path,
                                               std::move(volume),
                                               ZarrTriple{ scale.size[2], scale.size[1], scale.size[0] },
                                               part);
    return scan;
  });
}

} // namespace voxelcore
