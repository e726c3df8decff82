// OME-Zarr stores that readers of both of its versions open: metadata stand there as of Zarr 2 (OME-Zarr 0.4) and as of
// Zarr 3 (0.5), whose key encoding "v2" gives chunks the same names. https://ngff.openmicroscopy.org

#include "PackedFile.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Formats/VolumeWriters.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

namespace voxelcore
{
namespace
{

using Json = nlohmann::ordered_json;

constexpr bool kBigEndian = std::endian::native == std::endian::big;

// Slices are gathered until a layer of chunks is full: 16 of 2000 x 2000 float values are 256 MB.
constexpr std::array<std::int64_t, 3> kChunk{ 256, 256, 16 }; ///< i, j, k

/** Where an axis of voxels leads, 2 * axis of LPS (+ 1 where it goes against it). */
std::array<std::size_t, 3>
WaysOf(const ImageGeometry & geometry)
{
  constexpr double           straight = 1e-5; // what NIfTI's single precision leaves
  std::array<std::size_t, 3> ways{};
  for (std::size_t a = 0; a < 3; ++a)
  {
    std::size_t lps = 0;
    for (std::size_t c = 1; c < 3; ++c)
    {
      lps = std::abs(geometry.direction[3 * c + a]) > std::abs(geometry.direction[3 * lps + a]) ? c : lps;
    }
    const double along = geometry.direction[3 * lps + a];
    if (std::abs(std::abs(along) - 1) > straight)
    {
      throw UsageError("OME-Zarr has no oblique axes; write .nrrd");
    }
    ways[a] = 2 * lps + (along < 0 ? 1 : 0);
  }
  return ways;
}

/** The members of an image, of labels those of labels too, in a version. */
Json
ImageMembers(const VolumeToWrite & volume, const std::array<std::size_t, 3> & ways, const char * version)
{
  constexpr std::array<const char *, 6> words{
    "right-to-left",         "left-to-right",        "anterior-to-posterior",
    "posterior-to-anterior", "inferior-to-superior", "superior-to-inferior"
  };
  const ImageGeometry & g = volume.geometry;
  Json                  axes = Json::array();
  Json                  scale = Json::array();
  Json                  translation = Json::array();
  for (const std::size_t a : { 2, 1, 0 })
  {
    Json axis{ { "name", std::string(1, "xyz"[a]) }, { "type", "space" } };
    if (g.unit == SpatialUnit::Millimetres)
    {
      axis["unit"] = "millimeter";
    }
    axis["orientation"] = { { "type", "anatomical" }, { "value", words[ways[a]] } };
    axes.push_back(std::move(axis));
    scale.push_back(g.spacing[a]);
    translation.push_back(g.origin[ways[a] / 2] * (ways[a] % 2 == 0 ? 1 : -1));
  }
  Json json{ { "multiscales",
               Json::array(
                 { { { "version", version },
                     { "axes", std::move(axes) },
                     { "datasets",
                       Json::array({ { { "path", "0" },
                                       { "coordinateTransformations",
                                         Json::array({ { { "type", "scale" }, { "scale", scale } },
                                                       { { "type", "translation" },
                                                         { "translation", translation } } }) } } }) } } }) } };
  if (!volume.labels)
  {
    return json;
  }
  Json about{ { "version", version } };
  for (const auto & [value, label] : *volume.labels)
  {
    about["properties"].push_back({ { "label-value", value }, { "name", label.name } });
    if (label.color)
    {
      Json rgba = Json::array();
      for (const double part : *label.color)
      {
        rgba.push_back(std::lround(255 * part));
      }
      rgba.push_back(255);
      about["colors"].push_back({ { "label-value", value }, { "rgba", std::move(rgba) } });
    }
  }
  json["image-label"] = std::move(about);
  return json;
}

void
WriteJson(const std::filesystem::path & path, const Json & json)
{
  WriteTextFile(path, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

void
MakeFolder(const std::filesystem::path & path)
{
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error)
  {
    FailOutput(path, error.value());
  }
}

void
WriteArrayMetadata(const std::filesystem::path &       folder,
                   const VolumeToWrite &               volume,
                   const std::array<std::int64_t, 3> & chunk)
{
  const auto & size = volume.geometry.size;
  const Json   shape{ size[2], size[1], size[0] };
  const Json   chunks{ chunk[2], chunk[1], chunk[0] };
  const bool   isReal = volume.type == PixelType::Float32;
  const Json   fill = isReal ? Json(0.0) : Json(0);
  const auto   bytes = PixelBytes(volume.type);
  const char * order = bytes == 1 ? "|" : kBigEndian ? ">" : "<";
  Json         codecs = Json::array();
  codecs.push_back(
    bytes == 1 ? Json{ { "name", "bytes" } }
               : Json{ { "name", "bytes" }, { "configuration", { { "endian", kBigEndian ? "big" : "little" } } } });
  codecs.push_back({ { "name", "gzip" }, { "configuration", { { "level", kPackingLevel } } } });
  WriteJson(folder / ".zarray",
            { { "zarr_format", 2 },
              { "shape", shape },
              { "chunks", chunks },
              { "dtype", Text(order, isReal ? "f" : "u", bytes) },
              { "compressor", { { "id", "gzip" }, { "level", kPackingLevel } } },
              { "fill_value", fill },
              { "order", "C" },
              { "filters", nullptr },
              { "dimension_separator", "/" } });
  WriteJson(folder / "zarr.json",
            { { "zarr_format", 3 },
              { "node_type", "array" },
              { "shape", shape },
              { "data_type", PixelName(volume.type) },
              { "chunk_grid", { { "name", "regular" }, { "configuration", { { "chunk_shape", chunks } } } } },
              { "chunk_key_encoding", { { "name", "v2" }, { "configuration", { { "separator", "/" } } } } },
              { "fill_value", fill },
              { "codecs", std::move(codecs) },
              { "dimension_names", { "z", "y", "x" } },
              { "attributes", Json::object() } });
}

/** The chunks of a layer of slices that lie one behind the other; of nothing but zeros none is written. */
void
WriteLayer(const std::filesystem::path &       folder,
           const VolumeToWrite &               volume,
           const std::array<std::int64_t, 3> & chunk,
           std::span<const std::byte>          slices)
{
  const auto &           size = volume.geometry.size;
  const auto             bytes = static_cast<std::int64_t>(PixelBytes(volume.type));
  const std::int64_t     count = std::ssize(slices) / (size[0] * size[1] * bytes);
  std::vector<std::byte> values(static_cast<std::size_t>(chunk[0] * chunk[1] * chunk[2] * bytes));
  for (std::int64_t j = 0; j < size[1]; j += chunk[1])
  {
    for (std::int64_t i = 0; i < size[0]; i += chunk[0])
    {
      ranges::fill(values, std::byte{ 0 });
      const auto row = static_cast<std::size_t>(std::min(chunk[0], size[0] - i) * bytes);
      for (std::int64_t k = 0; k < count; ++k)
      {
        for (std::int64_t y = j; y < std::min(j + chunk[1], size[1]); ++y)
        {
          std::memcpy(values.data() + ((k * chunk[1] + y - j) * chunk[0]) * bytes,
                      slices.data() + ((k * size[1] + y) * size[0] + i) * bytes,
                      row);
        }
      }
      if (ranges::all_of(values, [](std::byte one) { return one == std::byte{ 0 }; }))
      {
        continue;
      }
      const std::filesystem::path rows = folder / std::to_string(j / chunk[1]);
      MakeFolder(rows);
      PackedFile file(rows / std::to_string(i / chunk[0]), Wrapping::Gzip);
      file.Write(values);
      file.Close();
    }
  }
}

} // namespace

void
WriteOmeZarr(const std::filesystem::path & path, const VolumeToWrite & volume)
{
  const auto                        ways = WaysOf(volume.geometry);
  const auto &                      size = volume.geometry.size;
  const std::array<std::int64_t, 3> chunk{ std::min(kChunk[0], size[0]),
                                           std::min(kChunk[1], size[1]),
                                           std::min(kChunk[2], size[2]) };
  const std::filesystem::path       array = path / "0";
  MakeFolder(array);
  WriteArrayMetadata(array, volume, chunk);
  std::vector<std::byte> layer;
  for (std::int64_t k = 0; k < size[2]; ++k)
  {
    const auto slice = volume.slice(k);
    layer.insert(layer.end(), slice.begin(), slice.end());
    if ((k + 1) % chunk[2] == 0 || k + 1 == size[2])
    {
      WriteLayer(array / std::to_string(k / chunk[2]), volume, chunk, layer);
      layer.clear();
    }
  }
  WriteJson(path / ".zattrs", ImageMembers(volume, ways, "0.4"));
  WriteJson(path / ".zgroup", { { "zarr_format", 2 } });
  Json attributes = ImageMembers(volume, ways, "0.5");
  for (const char * of : { "multiscales", "image-label" }) // one version for all
  {
    if (attributes.contains(of))
    {
      (attributes[of].is_array() ? attributes[of][0] : attributes[of]).erase("version");
    }
  }
  attributes["version"] = "0.5";
  WriteJson(path / "zarr.json",
            { { "zarr_format", 3 }, { "node_type", "group" }, { "attributes", { { "ome", std::move(attributes) } } } });
}

} // namespace voxelcore
