// The voxels of a scan as bytes, for slices in a page.

#include "../voxelcore/CommandLine.h"
#include "voxelcore/Imaging/GreyVolume.h"
#include "voxelcore/Imaging/ScanRows.h"
#include "voxelcore/Jobs/InfoJob.h"
#include "voxelcore/Jobs/ReadInput.h"
#include "voxelcore/Options/Requests.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <emscripten.h>
#include <exception>
#include <nlohmann/json.hpp>
#include <string>
#include <unordered_map>
#include <vector>

namespace voxelcore
{
namespace
{

/** Grey values are shown from the one below which this part of them lies to the one above which it does: a few voxels
 *  of metal or air then leave the rest its contrast. */
constexpr double kBeyond = 0.005;

/** Grey values that are looked at for that, at most. */
constexpr std::int64_t kMostLookedAt = std::int64_t{ 1 } << 20;

struct ShownScan
{
  ImageGeometry             geometry;
  bool                      isGrey = false;
  std::int64_t              step = 1; ///< of the voxels along each axis every `step`-th is there
  std::vector<std::uint8_t> values;   ///< x fastest
  std::vector<float>        labels;   ///< of codes 1, 2, ...; 0 is the background. None of a grey scan
  float                     low = 0;  ///< of a grey scan the value of code 0
  float                     high = 0; ///< and of code 255
};

std::int64_t
Count(const std::array<std::int64_t, 3> & size, std::int64_t step)
{
  return ((size[0] - 1) / step + 1) * ((size[1] - 1) / step + 1) * ((size[2] - 1) / step + 1);
}

VoxelBox
WholeOf(const ImageGeometry & geometry)
{
  VoxelBox box;
  for (std::size_t k = 0; k < 3; ++k)
  {
    box.size[k] = static_cast<std::int32_t>(geometry.size[k]);
  }
  return box;
}

void
FindWindow(const std::filesystem::path & path, const ReadOptions & options, ShownScan & shown)
{
  const std::int64_t all = Count(shown.geometry.size, 1);
  const std::int64_t every = (all + kMostLookedAt - 1) / kMostLookedAt;
  std::vector<float> seen;
  std::int64_t       next = 0; // voxels of the rows to come that are passed by
  VisitGreyRows(path, WholeOf(shown.geometry), options, [&](std::int32_t, std::int32_t, std::span<const float> row) {
    for (; next < static_cast<std::int64_t>(row.size()); next += every)
    {
      seen.push_back(row[static_cast<std::size_t>(next)]);
    }
    next -= static_cast<std::int64_t>(row.size());
  });
  const auto at = [&](double part) {
    const auto place = seen.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(seen.size() - 1));
    std::nth_element(seen.begin(), place, seen.end());
    return *place;
  };
  shown.low = at(kBeyond);
  shown.high = at(1 - kBeyond);
  if (shown.low == shown.high)
  {
    const auto [least, greatest] = std::minmax_element(seen.begin(), seen.end());
    shown.low = *least;
    shown.high = *greatest;
  }
}

ShownScan
ReadShown(const std::filesystem::path & path, const ReadOptions & options, std::int64_t most)
{
  ShownScan shown;
  shown.geometry = ScanRows(path, options).Geometry();
  while (Count(shown.geometry.size, shown.step) > most)
  {
    ++shown.step;
  }
  shown.isGrey = options.threshold.has_value();
  if (shown.isGrey)
  {
    FindWindow(path, options, shown);
  }
  std::unordered_map<float, std::uint8_t> codes{ { 0.0F, std::uint8_t{ 0 } } };
  const auto                              codeOf = [&](float value) {
    const auto [found, isNew] = codes.try_emplace(value, static_cast<std::uint8_t>(1 + shown.labels.size() % 255));
    if (isNew)
    {
      shown.labels.push_back(value);
    }
    return found->second;
  };
  const float scale = shown.high > shown.low ? 255 / (shown.high - shown.low) : 0;
  shown.values.reserve(static_cast<std::size_t>(Count(shown.geometry.size, shown.step)));
  const auto step = static_cast<std::size_t>(shown.step);
  VisitGreyRows(path,
                WholeOf(shown.geometry),
                options,
                [&](std::int32_t y, std::int32_t z, std::span<const float> row) {
                  if (y % shown.step != 0 || z % shown.step != 0)
                  {
                    return;
                  }
                  float        last = 0;
                  std::uint8_t lastCode = 0;
                  for (std::size_t x = 0; x < row.size(); x += step)
                  {
                    if (shown.isGrey)
                    {
                      shown.values.push_back(
                        static_cast<std::uint8_t>(std::clamp((row[x] - shown.low) * scale, 0.0F, 255.0F)));
                      continue;
                    }
                    if (row[x] != last)
                    {
                      last = row[x];
                      lastCode = codeOf(last);
                    }
                    shown.values.push_back(lastCode);
                  }
                });
  return shown;
}

nlohmann::json
ToJson(const ShownScan & shown)
{
  const ImageGeometry & geometry = shown.geometry;
  nlohmann::json        json{ { "step", shown.step },
                       { "origin", geometry.origin },
                       { "unit", geometry.unit == SpatialUnit::Millimetres ? "mm" : "vox" } };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    json["size"].push_back((geometry.size[axis] - 1) / shown.step + 1);
    Vector3 way;
    for (std::size_t k = 0; k < 3; ++k)
    {
      way[k] = geometry.direction[3 * k + axis] * geometry.spacing[axis] * static_cast<double>(shown.step);
    }
    json["axes"].push_back(way);
  }
  if (shown.isGrey)
  {
    json["window"] = { shown.low, shown.high };
  }
  else
  {
    json["labels"] = shown.labels;
  }
  return json;
}

} // namespace
} // namespace voxelcore

// `words`: {"args": words behind `voxelcore info`, "most": voxels}. Gives {"size", "step", "origin", "axes", "unit",
// "labels" or "window", "at", "count"}: bytes from address `at` on; {} of a mesh; {"error"} where the scan cannot be
// read. All lives until the next call.
extern "C" EMSCRIPTEN_KEEPALIVE const char *
ReadShownScan(const char * words)
{
  using namespace voxelcore; // NOLINT: a door of the program
  static ShownScan   shown;
  static std::string text;
  try
  {
    const nlohmann::json     asked = nlohmann::json::parse(words);
    std::vector<std::string> args{ "voxelcore", "info" };
    for (const auto & word : asked.at("args"))
    {
      args.push_back(word.get<std::string>());
    }
    std::vector<char *> pointers;
    for (std::string & word : args)
    {
      pointers.push_back(word.data());
    }
    const InfoOptions options =
      InfoOptionsFrom(ParseCommandLine(static_cast<int>(pointers.size()), pointers.data()).values);
    nlohmann::json json = nlohmann::json::object();
    if (!IsMeshFile(options.scan))
    {
      shown = ReadShown(options.scan, options.reading, asked.at("most").get<std::int64_t>());
      json = ToJson(shown);
      json["at"] = reinterpret_cast<std::uintptr_t>(shown.values.data());
      json["count"] = shown.values.size();
    }
    text = json.dump();
  }
  catch (const std::exception & error)
  {
    text = nlohmann::json{ { "error", error.what() } }.dump();
  }
  return text.c_str();
}
