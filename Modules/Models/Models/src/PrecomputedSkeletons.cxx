// Skeletons for Neuroglancer: a file a label, and what describes them.
// https://github.com/google/neuroglancer/blob/master/src/datasource/precomputed/skeletons.md

#include "voxelcore/Base/OutputFile.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Models/SkeletonModel.h"

#include <bit>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

namespace voxelcore
{
namespace
{

/** Of one label, in nanometres. */
struct Segment
{
  std::vector<float>                                   points; ///< x, y, z
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  std::vector<float>                                   radii;
  std::string                                          name;
};

template <typename T>
void
Put(std::string & bytes, T value)
{
  auto bits = bit_cast<std::uint32_t>(value);
  for (int byte = 0; byte < 4; ++byte, bits >>= 8U)
  {
    bytes += static_cast<char>(bits & 255U);
  }
}

void
AddPart(const SkeletonPart & part, std::map<std::int64_t, Segment> & segments)
{
  constexpr double                                               nanometres = 1e6;
  const auto &                                                   graph = part.graph;
  const auto &                                                   radii = SectionRadii(graph);
  std::map<std::pair<std::int64_t, ElementIndex>, std::uint32_t> numbers; // of a label's points: branches share ends
  const auto numberOf = [&](std::int64_t label, ElementIndex point) {
    Segment & segment = segments[label];
    const auto [place, isNew] = numbers.try_emplace({ label, point }, static_cast<std::uint32_t>(segment.radii.size()));
    if (isNew)
    {
      for (const double coordinate : graph.positions[point])
      {
        segment.points.push_back(static_cast<float>(nanometres * coordinate));
      }
      segment.radii.push_back(static_cast<float>(nanometres * radii[point]));
    }
    return place->second;
  };
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    const std::int64_t label = part.network ? graph.BranchLabel(branch) : part.label;
    const auto         points = graph.Branch(branch);
    for (std::size_t i = 1; i < points.size(); ++i)
    {
      const std::uint32_t from = numberOf(label, points[i - 1]);
      const std::uint32_t to = numberOf(label, points[i]);
      segments[label].edges.emplace_back(from, to);
    }
  }
  for (std::size_t node = 0; node < graph.nodePoints.size(); ++node)
  {
    if (graph.nodeKinds[node] == NodeKind::Isolated)
    {
      const ElementIndex point = graph.nodePoints[node];
      (void)numberOf(part.network ? graph.labels[point] : part.label, point);
    }
  }
  if (!part.network)
  {
    segments[part.label].name = part.component > 0 ? part.name.substr(0, part.name.rfind('#')) : part.name;
    return;
  }
  for (const NetworkLabel & label : part.network->labels)
  {
    segments[label.value].name = label.name;
  }
}

void
WriteBytes(const std::filesystem::path & path, const std::string & bytes)
{
  OutputFile file(path);
  file.Write(bytes);
  file.Finish();
}

} // namespace

void
WritePrecomputedSkeletons(const std::function<std::filesystem::path(const std::string & name)> & place,
                          const SkeletonModel &                                                  model)
{
  using Json = nlohmann::ordered_json;
  std::map<std::int64_t, Segment> segments;
  for (const SkeletonPart & part : model.parts)
  {
    AddPart(part, segments);
  }
  Json ids = Json::array();
  Json names = Json::array();
  for (const auto & [label, segment] : segments)
  {
    std::string bytes;
    Put(bytes, static_cast<std::uint32_t>(segment.radii.size()));
    Put(bytes, static_cast<std::uint32_t>(segment.edges.size()));
    for (const float coordinate : segment.points)
    {
      Put(bytes, coordinate);
    }
    for (const auto & [from, to] : segment.edges)
    {
      Put(bytes, from);
      Put(bytes, to);
    }
    for (const float radius : segment.radii)
    {
      Put(bytes, radius);
    }
    WriteBytes(place(std::to_string(label)), bytes);
    ids.push_back(std::to_string(label));
    names.push_back(segment.name);
  }
  const Json properties = {
    { "@type", "neuroglancer_segment_properties" },
    { "inline",
      { { "ids", ids }, { "properties", { { { "id", "label" }, { "type", "label" }, { "values", names } } } } } }
  };
  const Json info = { { "@type", "neuroglancer_skeletons" },
                      { "transform", { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0 } },
                      { "vertex_attributes",
                        { { { "id", "radius" }, { "data_type", "float32" }, { "num_components", 1 } } } },
                      { "segment_properties", "names" } };
  const auto text = [](const Json & json) { return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n"; };
  WriteBytes(place("names/info"), text(properties));
  WriteBytes(place("info"), text(info));
}

} // namespace voxelcore
