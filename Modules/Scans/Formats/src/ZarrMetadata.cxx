#include "ZarrMetadata.h"

#include "ResolvedPaths.h"

#include "voxelcore/Base/JsonText.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Formats/ByteStream.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

namespace voxelcore
{

using Json = nlohmann::json;

namespace
{

constexpr std::uint64_t kLongestJson = 64U << 20;
constexpr std::uint64_t kLongestSide = std::uint64_t{ 1 } << 40;

template <typename T>
std::vector<std::byte>
BytesOf(T value, bool bigEndian)
{
  std::vector<std::byte> bytes(sizeof(T));
  std::memcpy(bytes.data(), &value, sizeof(T));
  if (bigEndian != (std::endian::native == std::endian::big))
  {
    std::reverse(bytes.begin(), bytes.end());
  }
  return bytes;
}

template <typename T>
std::vector<std::byte>
FillBytes(const Json & value, bool bigEndian)
{
  if constexpr (std::is_floating_point_v<T>)
  {
    const std::string text = value.is_string() ? value.get<std::string>() : "";
    const T           number = text == "NaN"         ? std::numeric_limits<T>::quiet_NaN()
                               : text == "Infinity"  ? std::numeric_limits<T>::infinity()
                               : text == "-Infinity" ? -std::numeric_limits<T>::infinity()
                                                     : value.get<T>();
    return BytesOf(number, bigEndian);
  }
  else
  {
    if (value.is_boolean())
    {
      return BytesOf(static_cast<T>(value.get<bool>() ? 1 : 0), bigEndian);
    }
    // All digits of a whole number count; one written as a fraction is whole up to the largest that is below T's end.
    const bool   isWhole = value.is_number_integer();
    const double number = value.get<double>();
    const bool   fits = value.is_number_unsigned() ? std::in_range<T>(value.get<std::uint64_t>())
                        : isWhole                  ? std::in_range<T>(value.get<std::int64_t>())
                                                   : number == std::floor(number) &&
                                    number >= static_cast<double>(std::numeric_limits<T>::min()) &&
                                    number < std::ldexp(1.0, std::numeric_limits<T>::digits);
    if (!fits)
    {
      throw Json::other_error::create(599, "no value of its type", nullptr);
    }
    return BytesOf(isWhole ? value.get<T>() : static_cast<T>(number), bigEndian);
  }
}

} // namespace

void
RefuseMetadata(const std::filesystem::path & folder, const std::string & what)
{
  RefuseInput(folder,
              Text("its Zarr metadata ", what),
              "the store is damaged or not written to the end: write it anew");
}

const Json &
Member(const std::filesystem::path & folder, const Json & json, const char * key)
{
  if (!json.is_object() || !json.contains(key))
  {
    RefuseMetadata(folder, Text("have no '", key, "'"));
  }
  return json.at(key);
}

std::string
Word(const std::filesystem::path & folder, const Json & json, const char * key)
{
  const Json & value = Member(folder, json, key);
  if (!value.is_string())
  {
    RefuseMetadata(folder, Text("have a '", key, "' that is no text"));
  }
  return value.get<std::string>();
}

std::vector<std::uint64_t>
Sides(const std::filesystem::path & folder, const Json & json, const char * key)
{
  const Json &               list = Member(folder, json, key);
  std::vector<std::uint64_t> sides;
  if (!list.is_array() || list.empty() || list.size() > kMostZarrAxes)
  {
    RefuseMetadata(folder, Text("have a '", key, "' that is no list of sides"));
  }
  for (const Json & side : list)
  {
    if (!side.is_number_unsigned() || side.get<std::uint64_t>() < 1 || side.get<std::uint64_t>() > kLongestSide)
    {
      RefuseMetadata(folder, Text("have a side in '", key, "' that is no size"));
    }
    sides.push_back(side.get<std::uint64_t>());
  }
  return sides;
}

PixelType
ZarrTypeOf(const std::filesystem::path & folder, const std::string & name)
{
  static const std::map<std::string, PixelType> known{
    { "b1", PixelType::UInt8 },        { "bool", PixelType::UInt8 },      { "u1", PixelType::UInt8 },
    { "uint8", PixelType::UInt8 },     { "i1", PixelType::Int8 },         { "int8", PixelType::Int8 },
    { "u2", PixelType::UInt16 },       { "uint16", PixelType::UInt16 },   { "i2", PixelType::Int16 },
    { "int16", PixelType::Int16 },     { "u4", PixelType::UInt32 },       { "uint32", PixelType::UInt32 },
    { "i4", PixelType::Int32 },        { "int32", PixelType::Int32 },     { "u8", PixelType::UInt64 },
    { "uint64", PixelType::UInt64 },   { "i8", PixelType::Int64 },        { "int64", PixelType::Int64 },
    { "f4", PixelType::Float32 },      { "float32", PixelType::Float32 }, { "f8", PixelType::Float64 },
    { "float64", PixelType::Float64 },
  };
  const auto found = known.find(name);
  if (found == known.end())
  {
    RefuseInput(folder, Text("values of type '", Printable(name, 30), "'"), "whole numbers are needed, one a voxel");
  }
  return found->second;
}

void
SetFill(const Json & value, ZarrArray & array)
{
  if (value.is_null())
  {
    return; // version 2: chunks that are not there are unknown
  }
  try
  {
    const auto set = [&]<typename T>(T) { array.fill = FillBytes<T>(value, array.bigEndian); };
    switch (array.type)
    {
      case PixelType::UInt8:
        return set(std::uint8_t{});
      case PixelType::Int8:
        return set(std::int8_t{});
      case PixelType::UInt16:
        return set(std::uint16_t{});
      case PixelType::Int16:
        return set(std::int16_t{});
      case PixelType::UInt32:
        return set(std::uint32_t{});
      case PixelType::Int32:
        return set(std::int32_t{});
      case PixelType::UInt64:
        return set(std::uint64_t{});
      case PixelType::Int64:
        return set(std::int64_t{});
      case PixelType::Float32:
        return set(float{});
      case PixelType::Float64:
        return set(double{});
    }
  }
  catch (const Json::exception &)
  {
    RefuseMetadata(array.folder, "have a fill value that is none of its type");
  }
}

void
RefuseCodec(const std::filesystem::path & folder, const std::string & name)
{
  RefuseInput(folder,
              Text("its chunks are packed by '", Printable(name, 40), "', which is not read here"),
              "write it with blosc, zstd, gzip or zlib, or none");
}

ZarrCodec
ZarrCodecOf(const std::filesystem::path & folder, std::string name)
{
  if (name.starts_with("numcodecs."))
  {
    name.erase(0, 10);
  }
  static const std::map<std::string, ZarrCodec> known{ { "gzip", ZarrCodec::Deflate }, { "zlib", ZarrCodec::Deflate },
#ifdef VOXELCORE_BZIP2
                                                       { "bz2", ZarrCodec::Bzip2 },
#endif
                                                       { "zstd", ZarrCodec::Zstd },    { "blosc", ZarrCodec::Blosc },
                                                       { "crc32c", ZarrCodec::Crc32c } };
  const auto found = known.find(name);
  if (found == known.end())
  {
    RefuseCodec(folder, name);
  }
  return found->second;
}

void
RequireInStore(const std::filesystem::path & folder, const std::filesystem::path & part)
{
  if (!ResolvedFolder(folder).Holds(part))
  {
    RefuseInput(part, "a link that leads out of the store", "copy what it leads to into the store, if you trust it");
  }
}

Json
ReadZarrJson(const std::filesystem::path & file)
{
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored))
  {
    return nullptr;
  }
  RequireInStore(file.parent_path(), file);
  const std::uint64_t size = FileSize(file);
  if (size > kLongestJson)
  {
    RefuseInput(file, "too long for metadata", "the store is damaged: write it anew");
  }
  std::string text(static_cast<std::size_t>(size), '\0');
  OpenBytes(file, 0, Packing::Plain)->Read(reinterpret_cast<std::byte *>(text.data()), text.size());
  Json json = Json::parse(PlainJson(text, text.size()), nullptr, false);
  if (!json.is_object())
  {
    RefuseInput(file, "no JSON object", "the store is damaged: copy or write it anew");
  }
  return json;
}

} // namespace voxelcore
