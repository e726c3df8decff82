// Prints what ReadLabelVolume makes of a scan, as JSON on one line, for comparison with other readers.
//
// usage: VoxelCoreDumpScan SCAN [NIFTI_FORM] [component=N] [volume=N] [level=N] [crop=I0:I1,J0:J1,K0:K1]
//        VoxelCoreDumpScan -        the same for each line of standard input, words separated by tabs

#include "voxelcore/Error.h"
#include "voxelcore/LabelVolume.h"

#include <cstdlib>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

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
    if (word.find('=') == std::string::npos)
    {
      options.niftiForm = word;
    }
  }
  return options;
}

Json
Dump(const std::vector<std::string> & words)
{
  const auto   volume = voxelcore::ReadLabelVolume(words.at(0), OptionsOf(words));
  const auto & g = volume.geometry;
  Json         json{ { "unit", voxelcore::UnitName(g.unit) },
             { "size", g.size },
             { "spacing", g.spacing },
             { "affine", Json::array() } };
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
