#include "ParametersJson.h"

#include "voxelcore/Error.h"

#include <cmath>
#include <limits>

namespace voxelcore
{

namespace
{

using Json = nlohmann::ordered_json;

/** JSON has no infinite numbers. */
Json
BoundJson(double bound)
{
  return std::isfinite(bound) ? Json(bound) : Json(bound > 0 ? "inf" : "-inf");
}

Json
ThresholdJson(const std::pair<double, double> & threshold)
{
  return Json::array({ BoundJson(threshold.first), BoundJson(threshold.second) });
}

double
ReadBound(const Json & json)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return !json.is_string() ? json.get<double>() : json.get<std::string>() == "inf" ? infinity : -infinity;
}

Json
CropJson(const CropRange & crop)
{
  Json json = Json::array();
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    json.push_back({ crop.first[axis], crop.end[axis] });
  }
  return json;
}

CropRange
ReadCrop(const Json & json)
{
  CropRange crop;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    json.at(axis).at(0).get_to(crop.first[axis]);
    json.at(axis).at(1).get_to(crop.end[axis]);
  }
  return crop;
}

void
AddEdits(Json & json, const ShapeEditOptions & edits)
{
  json["mend_shape"] = edits.mend;
  json["fill_cavities"] = edits.fillCavities;
  json["min_voxels"] = edits.minVoxels ? Json(*edits.minVoxels) : Json(nullptr);
  json["largest"] = edits.largest ? Json(*edits.largest) : Json(nullptr);
  json["smooth_shape"] = edits.smooth;
  json["split_components"] = edits.splitComponents;
}

template <typename T>
void
ReadOptional(const Json & json, std::optional<T> & value)
{
  if (!json.is_null())
  {
    value = json.get<T>();
  }
}

ShapeEditOptions
ReadEdits(const Json & json)
{
  ShapeEditOptions edits;
  edits.mend = json.value("mend_shape", false);
  json.at("fill_cavities").get_to(edits.fillCavities);
  ReadOptional(json.at("min_voxels"), edits.minVoxels);
  ReadOptional(json.at("largest"), edits.largest);
  edits.smooth = json.value("smooth_shape", false);
  json.at("split_components").get_to(edits.splitComponents);
  return edits;
}

} // namespace

nlohmann::ordered_json
ParametersJson(const ParameterRecord & parameters, bool inFile)
{
  Json json = Json::object();
  json["labels"] = parameters.labels;
  json["binary"] = parameters.binary;
  json["threshold"] = parameters.threshold ? ThresholdJson(*parameters.threshold) : Json(nullptr);
  json["volume"] = parameters.volume ? Json(*parameters.volume) : Json(nullptr);
  json["component"] = parameters.component ? Json(*parameters.component) : Json(nullptr);
  if (parameters.raw)
  {
    json["raw"] = RawLayoutText(*parameters.raw);
  }
  json["spacing"] = parameters.spacing ? Json(*parameters.spacing) : Json(nullptr);
  if (parameters.resolution)
  {
    json["resolution"] = *parameters.resolution;
  }
  json["orthonormalize"] = parameters.orthonormalize;
  json["nifti_form"] = parameters.niftiForm;
  json["crop"] = parameters.crop ? CropJson(*parameters.crop) : Json(nullptr);
  AddEdits(json, parameters.edits);
  json["lambda"] = parameters.lambda;
  if (!parameters.tolerances.empty())
  {
    json["tolerance"] = parameters.tolerances;
  }
  if (!parameters.refine.surface.empty())
  {
    json["refine"] = parameters.refine.surface;
    if (parameters.refine.greyRange)
    {
      json["grey_sha256"] = parameters.refine.greySha256;
      json["grey_range"] = ThresholdJson(*parameters.refine.greyRange);
    }
  }
  json["triangles"] = parameters.model.triangles;
  json["keep_edges"] = parameters.model.keepEdges;
  if (!inFile)
  {
    json["engine"] = parameters.engine;
    json["cross_check"] = parameters.crossCheck;
    json["threads"] = parameters.threads;
  }
  json["lattice_weights"] = parameters.weights.weight;
  json["lattice_unit_mm"] = parameters.weights.unit;
  json["lattice_deviation"] = parameters.weights.deviation;
  return json;
}

ParameterRecord
ReadParameters(const nlohmann::ordered_json & json)
{
  ParameterRecord parameters;
  json.at("labels").get_to(parameters.labels);
  json.at("binary").get_to(parameters.binary);
  if (!json.at("threshold").is_null())
  {
    parameters.threshold = { ReadBound(json.at("threshold").at(0)), ReadBound(json.at("threshold").at(1)) };
  }
  ReadOptional(json.at("volume"), parameters.volume);
  ReadOptional(json.at("component"), parameters.component);
  if (json.contains("raw"))
  {
    parameters.raw = ParseRawLayout(json.at("raw").get<std::string>());
  }
  ReadOptional(json.at("spacing"), parameters.spacing);
  if (json.contains("resolution"))
  {
    parameters.resolution = json.at("resolution").get<std::int64_t>();
  }
  json.at("orthonormalize").get_to(parameters.orthonormalize);
  json.at("nifti_form").get_to(parameters.niftiForm);
  if (!json.at("crop").is_null())
  {
    parameters.crop = ReadCrop(json.at("crop"));
  }
  parameters.edits = ReadEdits(json);
  json.at("lambda").get_to(parameters.lambda);
  if (json.contains("bumps"))
  {
    throw InputError("was pruned by the tolerance of VoxelCore 0.1; make it again");
  }
  parameters.tolerances = json.value("tolerance", std::vector<std::string>());
  parameters.refine.surface = json.value("refine", std::string());
  parameters.refine.greySha256 = json.value("grey_sha256", std::string());
  if (json.contains("grey_range"))
  {
    parameters.refine.greyRange = { ReadBound(json.at("grey_range").at(0)), ReadBound(json.at("grey_range").at(1)) };
  }
  json.at("triangles").get_to(parameters.model.triangles);
  json.at("keep_edges").get_to(parameters.model.keepEdges);
  json.at("lattice_weights").get_to(parameters.weights.weight);
  json.at("lattice_unit_mm").get_to(parameters.weights.unit);
  json.at("lattice_deviation").get_to(parameters.weights.deviation);
  return parameters;
}

} // namespace voxelcore
