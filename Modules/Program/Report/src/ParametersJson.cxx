#include "ParametersJson.h"

#include "EditsJson.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/SpatialUnit.h"
#include "voxelcore/Report/ParameterFields.h"

#include <cmath>
#include <limits>
#include <set>

namespace voxelcore
{

namespace
{

using Json = nlohmann::ordered_json;
using Range = std::pair<double, double>;

/** JSON has no infinite numbers. */
Json
BoundJson(double bound)
{
  return std::isfinite(bound) ? Json(bound) : Json(bound > 0 ? "inf" : "-inf");
}

double
ReadBound(const Json & json)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return !json.is_string() ? json.get<double>() : json.get<std::string>() == "inf" ? infinity : -infinity;
}

template <typename T>
Json
ValueJson(const T & value)
{
  return value;
}

Json
ValueJson(const Range & range)
{
  return Json::array({ BoundJson(range.first), BoundJson(range.second) });
}

Json
ValueJson(const CropRange & crop)
{
  Json json = Json::array();
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    json.push_back({ crop.first[axis], crop.end[axis] });
  }
  return json;
}

Json
ValueJson(const RawLayout & layout)
{
  return RawLayoutText(layout);
}

Json
ValueJson(const GapWidth & width)
{
  return width.text;
}

Json
ValueJson(MedianWidth width)
{
  return width.voxels;
}

Json
ValueJson(const VoxelChanges & changes)
{
  return VoxelChangesJson(changes);
}

Json
ValueJson(SliceAxis axis)
{
  return SliceAxisName(axis);
}

/** Only where it is not that of a voxel shape. */
Json
ValueJson(Connectivity connectivity)
{
  switch (connectivity)
  {
    case Connectivity::Six:
      return nullptr;
    case Connectivity::TwentySix:
      return static_cast<int>(connectivity);
    case Connectivity::Joined:
      break;
  }
  return std::string(ConnectivityName(connectivity));
}

template <typename T>
Json
ValueJson(const std::optional<T> & value)
{
  return value ? ValueJson(*value) : Json(nullptr);
}

template <typename T>
void
ReadValue(const Json & json, T & value)
{
  json.get_to(value);
}

void
ReadValue(const Json & json, Range & range)
{
  range = { ReadBound(json.at(0)), ReadBound(json.at(1)) };
}

void
ReadValue(const Json & json, CropRange & crop)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    json.at(axis).at(0).get_to(crop.first[axis]);
    json.at(axis).at(1).get_to(crop.end[axis]);
  }
}

void
ReadValue(const Json & json, RawLayout & layout)
{
  layout = ParseRawLayout(json.get<std::string>());
}

void
ReadValue(const Json & json, GapWidth & width)
{
  try
  {
    width = ParseGapWidth(json.get<std::string>());
  }
  catch (const UsageError & error)
  {
    throw InputError(std::string("its ") + error.what());
  }
}

void
ReadValue(const Json & json, MedianWidth & width)
{
  try
  {
    width = ParseMedianWidth(std::to_string(json.get<std::int32_t>()));
  }
  catch (const UsageError & error)
  {
    throw InputError(std::string("its width of a median: ") + error.what());
  }
}

void
ReadValue(const Json & json, VoxelChanges & changes)
{
  try
  {
    if (json.is_string()) // as former versions wrote it
    {
      changes = ParseVoxelChanges(json.get<std::string>());
      return;
    }
    std::string text;
    for (const Json & run : json)
    {
      text += run.get<std::string>() + ' ';
    }
    changes = ParseVoxelChanges(text);
  }
  catch (const UsageError & error)
  {
    throw InputError(std::string("its changed voxels: ") + error.what());
  }
}

void
ReadValue(const Json & json, SliceAxis & axis)
{
  const auto named = SliceAxisNamed(json.get<std::string>());
  if (!named)
  {
    throw InputError("its axis of slices is none");
  }
  axis = *named;
}

void
ReadValue(const Json & json, Connectivity & connectivity)
{
  const auto named = ConnectivityNamed(json.is_string() ? json.get<std::string>() : std::to_string(json.get<int>()));
  if (!named)
  {
    throw InputError("its connectivity is none");
  }
  connectivity = *named;
}

template <typename T>
void
ReadValue(const Json & json, std::optional<T> & value)
{
  if (!json.is_null())
  {
    ReadValue(json, value.emplace());
  }
}

// No options: `roots` asks for them by itself.
constexpr const char * kJoinTorn = "join_torn";
constexpr const char * kOpenAtBorder = "open_at_border";

/** Written only where they are set: what meshes or some formats alone have, and what few ask for. */
bool
IsOfSome(std::string_view name)
{
  return name == "resolution" || name == "cap" || name == "cover" || name == "dataset" || name == "level" ||
         name == "raw" || name == "close" || name == "fill_hollows" || name == kOpenAtBorder || name == "fill_slices" ||
         name == "connectivity" || name == "median" || name == "denoise" || name == "simplify_topology" ||
         name == "pieces" || name == "loops" || name == "cavities" || name == "change_voxels" || name == kJoinTorn;
}

/** Writes fields. */
class JsonFieldWriter
{
public:
  explicit JsonFieldWriter(Json & json)
    : m_Json(json)
  {}

  template <typename T>
  void
  operator()(const char * name, const T & value) const
  {
    const Json json = ValueJson(value);
    if (!IsOfSome(name) || !(json.is_null() || json == false))
    {
      m_Json[name] = json;
    }
  }

private:
  Json & m_Json;
};

/** Reads fields, and remembers their names. */
class JsonFieldReader
{
public:
  explicit JsonFieldReader(const Json & json)
    : m_Json(json)
  {}

  template <typename T>
  void
  operator()(const char * name, T & value)
  {
    m_Names.insert(name);
    if (!IsOfSome(name) || m_Json.contains(name))
    {
      ReadValue(AtLength(m_Json, name), value);
    }
  }

  bool
  Knows(const std::string & name) const
  {
    return m_Names.contains(name);
  }

private:
  const Json &          m_Json;
  std::set<std::string> m_Names;
};

} // namespace

nlohmann::ordered_json
ParametersJson(const ParameterRecord & parameters, bool inFile)
{
  Json                  json = Json::object();
  const JsonFieldWriter write(json);
  json["labels"] = parameters.labels;
  VisitScanFields(parameters, write);
  write(kJoinTorn, parameters.edits.joinTorn);
  write(kOpenAtBorder, parameters.edits.openAtBorder);
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
      json["grey_range"] = ValueJson(*parameters.refine.greyRange);
    }
    if (parameters.refine.at)
    {
      json["refined_at"]["lambda"] = parameters.refine.at->lambda;
      if (!parameters.refine.at->tolerance.empty())
      {
        json["refined_at"]["tolerance"] = parameters.refine.at->tolerance;
      }
    }
  }
  VisitModelFields(parameters.model, write);
  for (const auto & [name, text] : parameters.further)
  {
    json[name] = text;
  }
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
  JsonFieldReader read(json);
  if (json.contains("bumps"))
  {
    throw InputError("was pruned by the tolerance of VoxelCore 0.1; make it again");
  }
  read("labels", parameters.labels);
  VisitScanFields(parameters, read);
  read(kJoinTorn, parameters.edits.joinTorn);
  read(kOpenAtBorder, parameters.edits.openAtBorder);
  read("lambda", parameters.lambda);
  parameters.tolerances = json.value("tolerance", std::vector<std::string>());
  parameters.refine.surface = json.value("refine", std::string());
  parameters.refine.greySha256 = json.value("grey_sha256", std::string());
  if (json.contains("grey_range"))
  {
    ReadValue(json.at("grey_range"), parameters.refine.greyRange);
  }
  if (json.contains("refined_at"))
  {
    const Json & at = json.at("refined_at");
    parameters.refine.at = { at.at("lambda").get<std::string>(), at.value("tolerance", std::string()) };
  }
  VisitModelFields(parameters.model, read);
  read("lattice_weights", parameters.weights.weight);
  read("lattice_unit_mm", parameters.weights.unit);
  read("lattice_deviation", parameters.weights.deviation);
  static const std::set<std::string> others{
    "tolerance", "refine", "grey_sha256", "grey_range", "engine", "cross_check"
  };
  for (const auto & [name, value] : json.items())
  {
    if (value.is_string() && !read.Knows(name) && !others.contains(name))
    {
      parameters.further[name] = value.get<std::string>();
    }
  }
  return parameters;
}

} // namespace voxelcore
