// Prints what ReadLabelVolume makes of a scan, as JSON on one line, for comparison with other readers.
//
// usage: VoxelCoreDumpScan SCAN [form=auto|sform|qform] [component=N] [volume=N] [level=N] [spacing=H] [dataset=NAME]
//                          [threshold=LO:HI] [crop=I0:I1,J0:J1,K0:K1] [names]
//        VoxelCoreDumpScan -        the same for each line of standard input, words separated by tabs

#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Imaging/LabelVolume.h"

#include <cstdlib>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>
#include <zlib.h>

namespace
{

using Json = nlohmann::ordered_json;

voxelcore::ReadOptions
OptionsOf(const std::vector<std::string> & words)
{
  voxelcore::ReadOptions options;
  for (std::size_t i = 1; i < words.size(); ++i)
  {
    const std::string & word = words[i];
    const auto          value = [&](std::string_view key) {
      return word.starts_with(key) ? std::optional<std::int64_t>(std::atoll(word.c_str() + key.size())) : std::nullopt;
    };
    options.component = value("component=") ? value("component=") : options.component;
    options.volume = value("volume=") ? value("volume=") : options.volume;
    options.level = value("level=") ? value("level=") : options.level;
    if (word.starts_with("crop="))
    {
      options.crop = voxelcore::ParseCrop(word.substr(5));
    }
    else if (word.starts_with("dataset="))
    {
      options.dataset = word.substr(8);
    }
    else if (word.starts_with("spacing="))
    {
      options.spacing = voxelcore::ParseVoxelSize(word.substr(8));
    }
    else if (word.starts_with("form="))
    {
      options.niftiForm = word.substr(5);
    }
    else if (word.starts_with("threshold="))
    {
      options.threshold = { std::stod(word.substr(10)), std::stod(word.substr(word.find(':') + 1)) };
    }
  }
  return options;
}

/** The CRC-32 of a label's voxels as bytes 0 and 1, x fastest. */
unsigned long
MaskDigest(const voxelcore::LabelShape & label, const voxelcore::ImageGeometry & geometry)
{
  unsigned long      digest = crc32(0, nullptr, 0);
  const auto &       size = geometry.size;
  std::vector<Bytef> row(static_cast<std::size_t>(size[0]));
  const auto &       box = label.shape.Box();
  const auto         inside = [&](std::int64_t value, std::size_t axis) {
    return value >= box.lower[axis] && value < box.lower[axis] + box.size[axis];
  };
  for (std::int32_t z = 0; z < size[2]; ++z)
  {
    for (std::int32_t y = 0; y < size[1]; ++y)
    {
      for (std::int32_t x = 0; x < size[0]; ++x)
      {
        row[static_cast<std::size_t>(x)] =
          inside(x, 0) && inside(y, 1) && inside(z, 2) && label.shape.Contains(x, y, z) ? 1 : 0;
      }
      digest = crc32(digest, row.data(), static_cast<uInt>(row.size()));
    }
  }
  return digest;
}

Json
Dump(const std::vector<std::string> & words)
{
  const auto   volume = voxelcore::ReadLabelVolume(words.at(0), OptionsOf(words));
  const auto & g = volume.geometry;
  Json         json{ { "format", volume.format }, { "type", volume.pixelType }, { "unit", voxelcore::UnitName(g.unit) },
             { "size", g.size },          { "spacing", g.spacing },     { "affine", Json::array() } };
  for (std::size_t row = 0; row < 3; ++row)
  {
    for (std::size_t column = 0; column < 3; ++column)
    {
      json["affine"].push_back(g.direction[3 * row + column] * g.spacing[column]);
    }
    json["affine"].push_back(g.origin[row]);
  }
  for (const char * key : { "labels", "boxes", "names", "colors" })
  {
    json[key] = Json::object();
  }
  for (const auto & label : volume.labels)
  {
    const std::string value = std::to_string(label.value);
    json["labels"][value] = label.voxels;
    json["boxes"][value] = { label.shape.Box().lower, label.shape.Box().size };
    json["names"][value] = label.name;
    if (label.color)
    {
      json["colors"][value] = *label.color;
    }
  }
  if (words.back() == "names")
  {
    for (const auto & label : volume.labels)
    {
      json["more"][std::to_string(label.value)] = { { "name", label.name },
                                                    { "color", label.color.value_or(voxelcore::Color{ -1, -1, -1 }) },
                                                    { "mask", MaskDigest(label, g) } };
    }
  }
  return json;
}

} // namespace

int
main(int argc, char ** argv)
{
  const std::vector<std::string> words(argv + 1, argv + argc);
  const auto text = [](const Json & json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n"; };
  try
  {
    if (words.size() == 1 && words[0] == "-")
    {
      for (std::string line; std::getline(std::cin, line);)
      {
        std::vector<std::string> one;
        std::istringstream       stream(line);
        for (std::string word; std::getline(stream, word, '\t');)
        {
          one.push_back(word);
        }
        try
        {
          std::cout << text(Dump(one)) << std::flush;
        }
        catch (const voxelcore::InputError & error)
        {
          std::cout << text({ { "refused", error.what() } }) << std::flush;
        }
      }
      return 0;
    }
    std::cout << text(Dump(words));
  }
  catch (const voxelcore::InputError & error)
  {
    std::cerr << error.what() << "\n";
    return 3;
  }
  return 0;
}
