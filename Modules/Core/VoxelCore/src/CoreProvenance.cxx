#include "voxelcore/VoxelCore/CoreProvenance.h"

#include "voxelcore/Base/JsonText.h"
#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Shape/BodyFrame.h"
#include "voxelcore/VoxelCore/PolygonArea.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace voxelcore
{

namespace
{

using Json = nlohmann::ordered_json;

Json
TopologyJson(const TopologyNumbers & topology)
{
  return { { "euler", topology.euler }, { "betti", topology.betti } };
}

void
AddComplex(Json & json, const ComplexRecord & complex)
{
  json["vertices"] = complex.vertices;
  json["edges"] = complex.edges;
  json["faces"] = complex.faces;
  json.update(TopologyJson(complex.topology));
  json["area_mm2"] = complex.areaMm2;
  json["max_radius_mm"] = complex.maxRadiusMm;
}

Json
PruningJson(const CorePruning & pruning)
{
  Json json{ { "lambda", pruning.lambda }, { "lambda_mm", pruning.lambdaMm } };
  if (!pruning.tolerance.empty())
  {
    json["tolerance"] = pruning.tolerance;
    json["tolerance_mm"] = pruning.toleranceMm;
  }
  AddComplex(json, pruning.complex);
  if (!pruning.refined.empty())
  {
    json["mean_displacement_vox"] = pruning.meanMove;
    json["max_displacement_vox"] = pruning.farthestMove;
  }
  return json;
}

Json
ParametersJson(const ImageGeometry &           geometry,
               const std::vector<CoreOrigin> & origins,
               const CorePruning &             pruning,
               bool                            keepEdges)
{
  const SpacingWeights weights = ComputeLatticeWeights(geometry);
  Json                 json = Json::object();
  json["labels"] = Json::array();
  for (const CoreOrigin & origin : origins)
  {
    json["labels"].push_back(origin.label);
  }
  json["binary"] = false;
  for (const char * none : { "threshold", "volume", "component", "spacing" })
  {
    json[none] = nullptr;
  }
  json["orthonormalize"] = false;
  json["nifti_form"] = "auto";
  json["crop"] = nullptr;
  for (const CoreOrigin & origin : origins)
  {
    if (origin.connectivity == Connectivity::TwentySix)
    {
      json["connectivity"] = static_cast<int>(origin.connectivity);
    }
    else if (origin.connectivity != Connectivity::Six)
    {
      json["connectivity"] = ConnectivityName(origin.connectivity);
    }
  }
  json["mend_shape"] = false;
  json["fill_cavities"] = false;
  json["min_voxels"] = nullptr;
  json["largest"] = nullptr;
  json["smooth_shape"] = false;
  json["split_components"] = false;
  json["lambda"] = Json::array({ pruning.lambda });
  if (!pruning.tolerance.empty())
  {
    json["tolerance"] = Json::array({ pruning.tolerance });
  }
  if (!pruning.refined.empty())
  {
    json["refine"] = pruning.refined;
  }
  json["triangles"] = false;
  json["keep_edges"] = keepEdges;
  json["lattice_weights"] = weights.weight;
  json["lattice_unit_mm"] = weights.unit;
  json["lattice_deviation"] = weights.deviation;
  return json;
}

Json
OriginJson(const CoreOrigin & origin, const CorePruning & pruning, const ImageGeometry & geometry)
{
  const auto & spacing = geometry.spacing;
  Json         json = Json::object();
  json["label"] = origin.label;
  json["name"] = origin.name;
  json["voxels"] = origin.voxels;
  json["volume_mm3"] = static_cast<double>(origin.voxels) * (spacing[0] * spacing[1] * spacing[2]);
  json["bounding_box"] = { { "lower", origin.box.lower }, { "size", origin.box.size } };
  json["boundary_vertices"] = origin.boundaryVertices;
  json["shape"] = TopologyJson(origin.shape);
  json["core"] = Json::object();
  AddComplex(json["core"], origin.core);
  json["pruned"] = Json::array({ PruningJson(pruning) });
  const bool same = origin.shape == origin.core.topology;
  json["certificate"] = { { "topology", same },
                          { "enclosed", origin.enclosed },
                          { "passed", same && origin.enclosed } };
  return json;
}

/** Says of a refined core that is pruned on at which lambda it was refined; in the form and place of CoreReport. */
void
NoteRefinedAt(Json & parameters, const std::string & lambda)
{
  const Json & before = parameters.at("lambda").at(0);
  if (!parameters.contains("refine") || parameters.contains("refined_at") || before == lambda)
  {
    return;
  }
  Json changed = Json::object();
  for (const auto & [name, value] : parameters.items())
  {
    if (name == "triangles")
    {
      changed["refined_at"]["lambda"] = before;
    }
    changed[name] = value;
  }
  parameters = std::move(changed);
}

std::string
Dump(const Json & json)
{
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

} // namespace

namespace
{

/** Measured side by side, added up in the order of the faces. */
double
AreaOf(const MedialComplex & complex)
{
  constexpr std::size_t most = std::size_t{ 1 } << 16; // faces at a time
  const std::size_t     count = complex.cells.FaceCount();
  const bool            hasCorners = complex.cells.HasCorners();
  std::vector<double>   areas(std::min(count, most));
  double                sum = 0;
  for (std::size_t begin = 0; begin < count; begin += most)
  {
    const std::size_t some = std::min(count - begin, most);
    RunInParts(some > 10000, some, [&](std::size_t first, std::size_t last) {
      std::vector<ElementIndex> corners;
      for (std::size_t i = first; i < last; ++i)
      {
        const std::size_t face = begin + i;
        if (hasCorners)
        {
          areas[i] = PolygonArea(complex.positions, complex.cells.FaceVertices(face));
          continue;
        }
        corners.resize(complex.cells.FaceEdges(face).size());
        FindCorners(complex.cells, face, corners.data());
        areas[i] = PolygonArea(complex.positions, corners);
      }
    });
    for (std::size_t i = 0; i < some; ++i)
    {
      sum += areas[i];
    }
  }
  return sum;
}

} // namespace

ComplexRecord
DescribeComplex(const MedialComplex & complex, const TopologyNumbers & topology)
{
  ComplexRecord record;
  record.vertices = complex.cells.vertexCount;
  record.edges = complex.cells.edges.size();
  record.faces = complex.cells.FaceCount();
  record.topology = topology;
  record.areaMm2 = AreaOf(complex);
  if (!complex.radius.empty())
  {
    record.maxRadiusMm = *std::max_element(complex.radius.begin(), complex.radius.end());
  }
  return record;
}

MedialComplex
PlaceInLps(MedialComplex core, const ImageGeometry & geometry)
{
  RequireDistinctPositions(geometry);
  for (auto & position : core.positions)
  {
    position = LatticeToPhysical(geometry, OnPlaces(position));
  }
  if (IsLeftHanded(geometry))
  {
    CellComplex & cells = core.cells;
    const bool    hasCorners = cells.HasCorners();
    for (std::size_t face = 0; face < cells.FaceCount(); ++face)
    {
      const auto begin = static_cast<std::ptrdiff_t>(cells.faceOffsets[face]);
      const auto end = static_cast<std::ptrdiff_t>(cells.faceOffsets[face + 1]);
      if (begin != end)
      {
        // The first corner stays the first; edge i joins corner i and the next, so all edges turn round.
        if (hasCorners)
        {
          std::reverse(cells.faceVertices.begin() + begin + 1, cells.faceVertices.begin() + end);
        }
        std::reverse(cells.faceEdges.begin() + begin, cells.faceEdges.begin() + end);
      }
    }
  }
  return core;
}

std::string
CoreProvenanceJson(const ImageGeometry &            geometry,
                   const std::vector<CoreOrigin> &  origins,
                   const std::vector<CorePruning> & prunings,
                   bool                             keepEdges)
{
  Json json = Json::object();
  json["voxelcore"] = { { "version", VOXELCORE_VERSION } };
  // The scan's file is not known here: whoever needs its digest sees that there is none.
  json["input"] = { { "sha256", "" },
                    { "format", "image in memory" },
                    { "size", geometry.size },
                    { "spacing_mm", geometry.spacing },
                    { "origin_mm", geometry.origin },
                    { "direction", geometry.direction },
                    { "notes", Json::array() } };
  if (geometry.unit == SpatialUnit::Voxels)
  {
    json["input"]["unit"] = UnitName(geometry.unit);
  }
  json["parameters"] =
    ParametersJson(geometry, origins, prunings.empty() ? CorePruning() : prunings.front(), keepEdges);
  json["labels"] = Json::array();
  for (std::size_t i = 0; i < origins.size(); ++i)
  {
    json["labels"].push_back(OriginJson(origins[i], prunings.at(i), geometry));
  }
  return Dump(KeysInUnit(json, geometry.unit));
}

std::string
PrunedProvenanceJson(const std::string & text, const std::vector<CorePruning> & prunings)
{
  try
  {
    Json       json = Json::parse(PlainJson(text));
    const auto unit = UnitNamed(json.at("input").value("unit", UnitName(SpatialUnit::Millimetres)));
    if (!unit)
    {
      return {};
    }
    Json & labels = json.at("labels");
    if (labels.size() != prunings.size() || prunings.empty())
    {
      return {};
    }
    for (std::size_t i = 0; i < labels.size(); ++i)
    {
      CorePruning  pruning = prunings[i];
      const Json & before = labels.at(i).at("pruned").at(0);
      if (before.contains("tolerance"))
      {
        return {}; // lambda no longer says what is left
      }
      if (AtLength(before, "lambda_mm").get<double>() >= pruning.lambdaMm)
      {
        before.at("lambda").get_to(pruning.lambda);
        AtLength(before, "lambda_mm").get_to(pruning.lambdaMm);
      }
      if (i == 0)
      {
        NoteRefinedAt(json.at("parameters"), pruning.lambda);
        json.at("parameters").at("lambda") = Json::array({ pruning.lambda });
      }
      Json after = KeysInUnit(PruningJson(pruning), *unit);
      for (const char * moves : { "mean_displacement_vox", "max_displacement_vox" })
      {
        if (before.contains(moves))
        {
          after[moves] = before.at(moves);
        }
      }
      labels.at(i).at("pruned") = Json::array({ std::move(after) });
    }
    json.at("parameters").at("keep_edges") = true;
    return Dump(json);
  }
  catch (const nlohmann::json::exception &)
  {
    return {};
  }
}

std::vector<BodyPlace>
RecordedPlaces(const std::string & text)
{
  try
  {
    const Json    json = Json::parse(PlainJson(text));
    const Json &  input = json.at("input");
    ImageGeometry geometry;
    input.at("size").get_to(geometry.size);
    AtLength(input, "spacing_mm").get_to(geometry.spacing);
    AtLength(input, "origin_mm").get_to(geometry.origin);
    input.at("direction").get_to(geometry.direction);
    std::vector<BodyPlace> places;
    for (const Json & label : json.at("labels"))
    {
      BodyPlace & place = places.emplace_back(BodyPlace{ geometry, {} });
      label.at("bounding_box").at("lower").get_to(place.box.lower);
      label.at("bounding_box").at("size").get_to(place.box.size);
    }
    return places;
  }
  catch (const nlohmann::json::exception &)
  {
    return {};
  }
}

} // namespace voxelcore
