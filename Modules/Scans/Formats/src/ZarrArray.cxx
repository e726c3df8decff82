#include "ZarrArray.h"

#include "ZarrMetadata.h"
#include "voxelcore/Base/TextFields.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace voxelcore
{

using Json = nlohmann::json;

namespace
{

/** Strides of a chunk whose axes are stored in this order, slowest first. */
std::vector<std::uint64_t>
StridesOf(const std::vector<std::uint64_t> & chunk, const std::vector<std::size_t> & order)
{
  std::vector<std::uint64_t> strides(chunk.size());
  std::uint64_t              step = 1;
  for (std::size_t i = order.size(); i-- > 0;)
  {
    strides[order[i]] = step;
    step *= chunk[order[i]];
  }
  return strides;
}

std::vector<std::size_t>
PlainOrder(std::size_t axes, bool reversed = false)
{
  std::vector<std::size_t> order(axes);
  for (std::size_t i = 0; i < axes; ++i)
  {
    order[i] = reversed ? axes - 1 - i : i;
  }
  return order;
}

void
ReadVersion2(const Json & json, ZarrArray & array)
{
  const auto & folder = array.folder;
  const auto   dtype = Member(folder, json, "dtype");
  if (!dtype.is_string() || dtype.get<std::string>().size() < 3)
  {
    RefuseInput(folder, "its values are structures or texts", "save it with one whole number a voxel");
  }
  const auto name = dtype.get<std::string>();
  array.type = ZarrTypeOf(folder, name.substr(1));
  array.bigEndian = name[0] == '>';
  array.shape = Sides(folder, json, "shape");
  array.chunk = Sides(folder, json, "chunks");
  const std::string order = Word(folder, json, "order");
  if (order != "C" && order != "F")
  {
    RefuseMetadata(folder, "name an order that is neither C nor F");
  }
  array.strides = StridesOf(array.chunk, PlainOrder(array.chunk.size(), order == "F"));
  if (json.contains("filters") && !json.at("filters").empty())
  {
    const Json & first = json.at("filters").front();
    RefuseCodec(folder, first.is_object() ? first.value("id", "a filter") : "a filter");
  }
  if (const Json & compressor = Member(folder, json, "compressor"); !compressor.is_null())
  {
    array.codecs.push_back(ZarrCodecOf(folder, Word(folder, compressor, "id")));
  }
  SetFill(Member(folder, json, "fill_value"), array);
  array.separator = json.contains("dimension_separator") ? Word(folder, json, "dimension_separator") : ".";
}

/** The codecs of version 3: what turns axes, what makes bytes of values, what packs those. */
void
ReadCodecs(const Json & list, ZarrArray & array, bool isWithinShard = false)
{
  const auto &             folder = array.folder;
  std::vector<std::size_t> order = PlainOrder(array.chunk.size());
  bool                     isBytes = false;
  if (!list.is_array())
  {
    RefuseMetadata(folder, "have no list of codecs");
  }
  for (const Json & codec : list)
  {
    const std::string name = Word(folder, codec, "name");
    const Json        settings = codec.value("configuration", Json::object());
    if (isBytes)
    {
      array.codecs.push_back(ZarrCodecOf(folder, name));
    }
    else if (name == "transpose")
    {
      const Json & turned = Member(folder, settings, "order");
      if (!turned.is_array())
      {
        RefuseCodec(folder, "transpose by name");
      }
      const auto               before = order;
      std::vector<std::size_t> axes;
      for (const Json & axis : turned)
      {
        axes.push_back(axis.is_number_unsigned() ? axis.get<std::size_t>() : kMostZarrAxes);
      }
      const auto plain = PlainOrder(order.size());
      if (!std::is_permutation(axes.begin(), axes.end(), plain.begin(), plain.end()))
      {
        RefuseMetadata(folder, "turn axes that are not there");
      }
      for (std::size_t i = 0; i < axes.size(); ++i)
      {
        order[i] = before[axes[i]];
      }
    }
    else if (name == "bytes" || name == "endian")
    {
      isBytes = true;
      array.bigEndian = settings.value("endian", "little") == "big";
    }
    else if (name == "sharding_indexed" && !isWithinShard && order == PlainOrder(order.size()) && list.size() == 1)
    {
      const std::vector<std::uint64_t> whole = array.chunk;
      ZarrArray::Shards                shards;
      array.chunk = Sides(folder, settings, "chunk_shape");
      for (std::size_t a = 0; a < whole.size(); ++a)
      {
        if (array.chunk.size() != whole.size() || whole[a] % array.chunk[a] != 0)
        {
          RefuseMetadata(folder, "cut shards into chunks that do not fill them");
        }
        shards.chunks.push_back(whole[a] / array.chunk[a]);
      }
      shards.atEnd = settings.value("index_location", "end") == "end";
      const Json & index = Member(folder, settings, "index_codecs");
      if (!index.is_array() || index.empty() || index.size() > 2 || Word(folder, index[0], "name") != "bytes" ||
          index[0].value("configuration", Json::object()).value("endian", "little") != "little" ||
          (index.size() == 2 && Word(folder, index[1], "name") != "crc32c"))
      {
        RefuseCodec(folder, "an index of shards other than bytes and crc32c");
      }
      shards.hasChecksum = index.size() == 2;
      array.shards = std::move(shards);
      ReadCodecs(Member(folder, settings, "codecs"), array, true);
      return;
    }
    else
    {
      RefuseCodec(folder, name);
    }
  }
  if (!isBytes)
  {
    RefuseMetadata(folder, "name no codec that makes bytes of values");
  }
  array.strides = StridesOf(array.chunk, order);
}

void
ReadVersion3(const Json & json, ZarrArray & array)
{
  const auto & folder = array.folder;
  array.version = 3;
  array.type = ZarrTypeOf(folder, Word(folder, json, "data_type"));
  array.shape = Sides(folder, json, "shape");
  const Json & grid = Member(folder, json, "chunk_grid");
  if (Word(folder, grid, "name") != "regular")
  {
    RefuseMetadata(folder, "have chunks that are no regular grid");
  }
  array.chunk = Sides(folder, Member(folder, grid, "configuration"), "chunk_shape");
  const Json &      keys = Member(folder, json, "chunk_key_encoding");
  const std::string encoding = Word(folder, keys, "name");
  const Json        settings = keys.value("configuration", Json::object());
  if (encoding != "default" && encoding != "v2")
  {
    RefuseMetadata(folder, "name chunks in a way not known here");
  }
  array.separator = settings.value("separator", encoding == "default" ? "/" : ".");
  array.prefix = encoding == "default" ? "c" + array.separator : "";
  if (json.contains("storage_transformers") && !json.at("storage_transformers").empty())
  {
    RefuseMetadata(folder, "name a storage transformer, none of which is known here");
  }
  if (array.chunk.size() != array.shape.size())
  {
    RefuseMetadata(folder, "have chunks of another number of axes than the array");
  }
  ReadCodecs(Member(folder, json, "codecs"), array);
  SetFill(Member(folder, json, "fill_value"), array);
}

} // namespace

std::uint64_t
ZarrArray::ChunkBytes() const
{
  std::uint64_t bytes = PixelBytes(type);
  for (const std::uint64_t side : chunk)
  {
    bytes *= side; // RequireChunk() looked that it fits
  }
  return bytes;
}

std::filesystem::path
ZarrArray::ChunkFile(const std::vector<std::uint64_t> & index) const
{
  if (chunkFile)
  {
    return chunkFile(index);
  }
  std::string name = prefix;
  for (std::size_t a = 0; a < index.size(); ++a)
  {
    name += (a > 0 ? separator : "") + std::to_string(shards ? index[a] / shards->chunks[a] : index[a]);
  }
  return folder / name;
}

bool
IsZarrArray(const std::filesystem::path & folder)
{
  std::error_code ignored;
  if (std::filesystem::exists(folder / ".zarray", ignored))
  {
    return true;
  }
  return std::filesystem::exists(folder / "zarr.json", ignored) &&
         ReadZarrJson(folder / "zarr.json").value("node_type", "") == "array";
}

bool
IsZarr(const std::filesystem::path & folder)
{
  std::error_code ignored;
  for (const char * mark : { ".zarray", ".zgroup", ".zattrs", "zarr.json" })
  {
    if (std::filesystem::is_regular_file(folder / mark, ignored))
    {
      return true;
    }
  }
  return false;
}

ZarrArray
ReadZarrArray(const std::filesystem::path & folder)
{
  ZarrArray array;
  array.folder = folder;
  try
  {
    if (const Json version2 = ReadZarrJson(folder / ".zarray"); !version2.is_null())
    {
      ReadVersion2(version2, array);
    }
    else if (const Json version3 = ReadZarrJson(folder / "zarr.json"); !version3.is_null())
    {
      ReadVersion3(version3, array);
    }
    else
    {
      RefuseInput(folder, "no Zarr array", "name the folder of one, or of the image it belongs to");
    }
  }
  catch (const Json::exception &)
  {
    RefuseMetadata(folder, "hold something of another type than they should");
  }
  if (array.chunk.size() != array.shape.size())
  {
    RefuseMetadata(folder, "have chunks of another number of axes than the array");
  }
  if (array.separator != "." && array.separator != "/")
  {
    RefuseMetadata(folder, "separate numbers of chunks by neither . nor /");
  }
  if (std::count_if(array.codecs.begin(), array.codecs.end(), [](ZarrCodec one) { return one != ZarrCodec::Crc32c; }) >
      1)
  {
    RefuseCodec(folder, "several packings one in the other");
  }
  constexpr double largest = 2147483647; // that blosc knows, and enough
  double           bytes = static_cast<double>(PixelBytes(array.type));
  for (const std::uint64_t side : array.chunk)
  {
    bytes *= static_cast<double>(side);
  }
  if (bytes > largest)
  {
    RefuseInput(folder, "chunks of 2 GB or more", "the store is damaged, or write it with smaller chunks");
  }
  return array;
}

} // namespace voxelcore
