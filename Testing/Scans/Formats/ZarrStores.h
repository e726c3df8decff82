#pragma once
// Small Zarr stores whose metadata a test changes.

#include "NrrdFixtures.h"

#include <nlohmann/json.hpp>

namespace voxelcore::testing::zarr
{

using Json = nlohmann::json;

/** nrrd::kValues as axes z, y, x of 2 x 2 x 3, in one chunk. */
inline const std::string kBytes = RawAll<std::uint8_t>(nrrd::kValues);

/** A change of metadata (https://www.rfc-editor.org/rfc/rfc7386: null takes a member away), and what is said of it. */
struct Refusal
{
  const char * change;
  const char * text;
};

class Stores : public ::testing::Test
{
protected:
  /** An array of version 2. */
  std::filesystem::path
  Array2(const std::string & name, const char * change = "{}", const std::string & chunk = kBytes) const
  {
    Json json = Json::parse(R"({"zarr_format": 2, "shape": [2, 2, 3], "chunks": [2, 2, 3], "dtype": "|u1",
                                "order": "C", "filters": null, "compressor": null, "fill_value": 0})");
    json.merge_patch(Json::parse(change));
    json.emplace("compressor", nullptr); // which a change cannot set
    return Written(name, ".zarray", json, "0.0.0", chunk);
  }

  /** An array of version 3. */
  std::filesystem::path
  Array3(const std::string & name, const char * change = "{}", const std::string & chunk = kBytes) const
  {
    Json json = Json::parse(R"({"zarr_format": 3, "node_type": "array", "shape": [2, 2, 3], "data_type": "uint8",
      "chunk_grid": {"name": "regular", "configuration": {"chunk_shape": [2, 2, 3]}},
      "chunk_key_encoding": {"name": "default", "configuration": {"separator": "/"}},
      "fill_value": 0, "codecs": [{"name": "bytes", "configuration": {"endian": "little"}}], "attributes": {}})");
    json.merge_patch(Json::parse(change));
    return Written(name, "zarr.json", json, "c/0/0/0", chunk);
  }

  /** An image of OME-Zarr 0.4 with one array, called 0. */
  std::filesystem::path
  Image(const std::string & name, const char * change = "{}", const char * ofArray = "{}") const
  {
    Json json = Json::parse(R"({"version": "0.4", "axes": [{"name": "z", "type": "space", "unit": "millimeter"},
      {"name": "y", "type": "space", "unit": "millimeter"}, {"name": "x", "type": "space", "unit": "millimeter"}],
      "datasets": [{"path": "0", "coordinateTransformations": [{"type": "scale", "scale": [3, 2, 1]}]}]})");
    json.merge_patch(Json::parse(change));
    Array2(name + "/0", ofArray);
    Attributes(name, Json{ { "multiscales", Json::array({ json }) } }.dump());
    return m_Folder / name;
  }

  /** A group of version 2 with these attributes. */
  std::filesystem::path
  Attributes(const std::string & name, const std::string & text) const
  {
    m_Folder.Write(name + "/.zgroup", R"({"zarr_format": 2})");
    m_Folder.Write(name + "/.zattrs", text);
    return m_Folder / name;
  }

  static void
  ExpectRead(const std::filesystem::path & path, const ReadOptions & options = {})
  {
    nrrd::ExpectValues(ReadLabelVolume(path, options));
  }

  TempFolder m_Folder;

private:
  std::filesystem::path
  Written(const std::string & name,
          const char *        metadata,
          const Json &        json,
          const char *        file,
          const std::string & chunk) const
  {
    m_Folder.Write(name + "/" + metadata, json.dump());
    m_Folder.Write(name + "/" + file, chunk);
    return m_Folder / name;
  }
};

} // namespace voxelcore::testing::zarr
