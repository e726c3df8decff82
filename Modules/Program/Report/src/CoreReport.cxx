#include "voxelcore/Report/CoreReport.h"

#include "EditsJson.h"
#include "ParametersJson.h"
#include "SkeletonJson.h"
#include "voxelcore/VoxelCore/PolygonArea.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>

namespace voxelcore
{

namespace
{

using Json = nlohmann::ordered_json;

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
InputJson(const InputRecord & input, bool inFile)
{
  Json json = Json::object();
  if (!inFile)
  {
    json["path"] = input.path;
  }
  json["sha256"] = input.sha256;
  json["format"] = input.format;
  json["size"] = input.geometry.size;
  json["spacing_mm"] = input.geometry.spacing;
  json["origin_mm"] = input.geometry.origin;
  json["direction"] = input.geometry.direction;
  json["notes"] = input.notes;
  if (input.geometry.unit == SpatialUnit::Voxels)
  {
    json["unit"] = UnitName(input.geometry.unit);
  }
  return json;
}

Json
LabelJson(const LabelRecord & label, bool inFile)
{
  Json json = Json::object();
  json["label"] = label.label;
  if (label.component != 0)
  {
    json["component"] = label.component;
  }
  json["name"] = label.name;
  if (label.edits)
  {
    json["edits"] = EditRecordJson(*label.edits, inFile);
  }
  if (label.hollow && !inFile)
  {
    json["hollow"] = { { "voxels", label.hollow->voxels },
                       { "share", label.hollow->share },
                       { "holes_vox", label.hollow->holes } };
  }
  json["voxels"] = label.voxels;
  json["volume_mm3"] = label.volumeMm3;
  json["bounding_box"] = { { "lower", label.box.lower }, { "size", label.box.size } };
  json["boundary_vertices"] = label.boundaryVertices;
  json["shape"] = TopologyJson(label.shape);
  if (!inFile && label.diagnosis)
  {
    json["diagnosis"] = { { "touching_pieces", label.diagnosis->touching },
                          { "touching_voxels", label.diagnosis->touchingVoxels },
                          { "islands", label.diagnosis->islands },
                          { "island_voxels", label.diagnosis->islandVoxels },
                          { "largest_island_voxels", label.diagnosis->largestIsland },
                          { "pieces_a_voxel_apart", label.diagnosis->torn },
                          { "loops_a_voxel_wide", label.diagnosis->loops },
                          { "bridges_a_voxel_wide", label.diagnosis->bridges },
                          { "cavities_a_voxel_wide", label.diagnosis->cavities },
                          { "options", label.diagnosis->NoiseOptions() } };
  }
  if (!label.hasCore)
  {
    return json;
  }
  json["core"] = Json::object();
  AddComplex(json["core"], label.core);
  json["pruned"] = Json::array();
  for (const PrunedRecord & pruned : label.pruned)
  {
    Json one = { { "lambda", pruned.lambda }, { "lambda_mm", pruned.lambdaMm } };
    if (pruned.tolerance)
    {
      one["tolerance"] = pruned.tolerance->height;
      one["tolerance_mm"] = pruned.tolerance->heightMm;
    }
    AddComplex(one, pruned.complex);
    if (!inFile && pruned.tolerance)
    {
      // Whoever prunes a finished file has no boundary to measure it on.
      one["boundary_gap_mm"] = pruned.tolerance->boundaryGapMm ? Json(*pruned.tolerance->boundaryGapMm) : Json(nullptr);
      if (pruned.tolerance->boundaryGapShare)
      {
        one["boundary_gap_share"] = *pruned.tolerance->boundaryGapShare;
      }
    }
    if (pruned.refined)
    {
      one["mean_displacement_vox"] = pruned.refined->meanDisplacement;
      one["max_displacement_vox"] = pruned.refined->maxDisplacement;
      if (!inFile && pruned.tolerance)
      {
        one["hairs_removed"] = pruned.refined->hairsRemoved;
      }
      if (!inFile && pruned.refined->radiusMargin)
      {
        // Files have it at each vertex.
        one["mean_radius_margin_mm"] = pruned.refined->radiusMargin->mean;
        one["max_radius_margin_mm"] = pruned.refined->radiusMargin->max;
      }
    }
    if (!inFile)
    {
      one["output"] = pruned.output;
    }
    json["pruned"].push_back(std::move(one));
  }
  json["certificate"] = { { "topology", label.topologyEqual }, { "enclosed", label.enclosed } };
  if (!inFile && label.covered)
  {
    json["certificate"]["covered"] = *label.covered;
  }
  if (label.skeleton)
  {
    json["skeleton"] = SkeletonRecordJson(*label.skeleton, inFile);
    json["certificate"]["skeleton"] = label.skeleton->topology == label.shape;
    if (!inFile && label.standOut)
    {
      json["certificate"]["stand_out"] = *label.standOut;
    }
  }
  json["certificate"]["passed"] = label.Passed();
  return json;
}

Json
WholeJson(const CoreReport & report, bool inFile)
{
  Json json = Json::object();
  json["voxelcore"] = { { "version", VoxelCoreVersion() } };
  if (!inFile)
  {
    json["voxelcore"]["command"] = report.command;
  }
  json["input"] = InputJson(report.input, inFile);
  json["parameters"] = ParametersJson(report.parameters, inFile);
  if (report.skeleton)
  {
    json["skeleton"] = SkeletonStageJson(*report.skeleton);
  }
  json["labels"] = Json::array();
  for (const LabelRecord & label : report.labels)
  {
    json["labels"].push_back(LabelJson(label, inFile));
  }
  return KeysInUnit(json, report.input.geometry.unit);
}

/** Adds a label, and its value to the parameters once. */
void
AddLabel(CoreReport & report, LabelRecord label)
{
  std::vector<std::int64_t> & values = report.parameters.labels;
  if (label.component <= 1 || values.empty() || values.back() != label.label)
  {
    values.push_back(label.label);
  }
  report.labels.push_back(std::move(label));
}

/** Names out of scans may hold bytes that are no UTF-8. */
std::string
Dump(const Json & json)
{
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/** Indented, but lists of plain values stay on one line. */
void
Indent(const Json & json, const std::string & margin, std::string & text)
{
  const bool plain = std::none_of(json.begin(), json.end(), [](const Json & item) { return item.is_structured(); });
  if (!json.is_structured() || json.empty() || (json.is_array() && plain))
  {
    text += Dump(json);
    return;
  }
  const std::string inner = margin + "  ";
  text += json.is_object() ? "{" : "[";
  std::string separator = "\n";
  for (const auto & [key, value] : json.items())
  {
    text += separator + inner + (json.is_object() ? Dump(Json(key)) + ": " : std::string());
    Indent(value, inner, text);
    separator = ",\n";
  }
  text += "\n" + margin + (json.is_object() ? "}" : "]");
}

double
Milliseconds(double seconds)
{
  return std::round(seconds * 1000) / 1000;
}

} // namespace

void
NoteRefinedAt(ParameterRecord & parameters)
{
  if (!parameters.refine.surface.empty() && !parameters.refine.at)
  {
    parameters.refine.at = { parameters.lambda.front(),
                             parameters.tolerances.empty() ? std::string() : parameters.tolerances.front() };
  }
}

std::string
ReportJson(const CoreReport & report, const std::optional<ReportMember> & further)
{
  Json                 json = WholeJson(report, false);
  const StageSeconds & seconds = report.seconds;
  json["seconds"] = { { "read", Milliseconds(seconds.read) },
                      { "shape", Milliseconds(seconds.shape) },
                      { "delaunay", Milliseconds(seconds.delaunay) },
                      { "core", Milliseconds(seconds.core) },
                      { "prune", Milliseconds(seconds.prune) } };
  if (report.skeleton)
  {
    json["seconds"]["skeleton"] = Milliseconds(seconds.skeleton);
  }
  json["seconds"]["write"] = Milliseconds(seconds.write);
  json["seconds"]["total"] = Milliseconds(seconds.total);
  json["peak_memory_mb"] = std::round(report.peakMemoryMb * 10) / 10;
  if (further)
  {
    json[further->name] = KeysInUnit(Json::parse(further->json), report.input.geometry.unit);
  }
  std::string text;
  Indent(json, "", text);
  return text + "\n";
}

std::string
ProvenanceJson(const CoreReport & report, const std::vector<std::size_t> & labels, std::size_t which)
{
  CoreReport part;
  part.input = report.input;
  part.parameters = report.parameters;
  part.parameters.labels.clear();
  if (report.parameters.tolerances.empty())
  {
    part.parameters.lambda = { report.parameters.lambda.at(which) };
  }
  else
  {
    part.parameters.tolerances = { report.parameters.tolerances.at(which) };
  }
  if (report.parameters.refine.at)
  {
    ParameterRecord now = part.parameters;
    now.refine.at.reset();
    NoteRefinedAt(now);
    if (now.refine.at->lambda == part.parameters.refine.at->lambda &&
        now.refine.at->tolerance == part.parameters.refine.at->tolerance)
    {
      part.parameters.refine.at.reset();
    }
  }
  for (const std::size_t index : labels)
  {
    LabelRecord label = report.labels.at(index);
    label.pruned = { report.labels[index].pruned.at(which) };
    label.skeleton.reset();
    AddLabel(part, std::move(label));
  }
  return Dump(WholeJson(part, true));
}

std::string
SkeletonProvenanceJson(const CoreReport & report, const std::vector<std::size_t> & labels)
{
  CoreReport part;
  part.input = report.input;
  part.parameters = report.parameters;
  part.parameters.labels.clear();
  part.parameters.lambda = { report.skeleton.value().lambda.text };
  part.parameters.tolerances.clear();
  part.parameters.model.keepEdges = false; // changes nothing here
  part.skeleton = report.skeleton;
  for (const std::size_t index : labels)
  {
    LabelRecord  label = report.labels.at(index);
    PrunedRecord source{ { "0", 0, label.core, {}, {} } };
    for (const PrunedRecord & pruned : report.labels[index].pruned)
    {
      const auto & height = report.skeleton->tolerance;
      const bool   same = height ? pruned.tolerance && pruned.tolerance->height == height->text : !pruned.tolerance;
      source = pruned.lambda == report.skeleton->lambda.text && same ? pruned : source;
    }
    label.pruned = { source };
    AddLabel(part, std::move(label));
  }
  return Dump(WholeJson(part, true));
}

std::string
LabelRecordJson(const LabelRecord & label, SpatialUnit unit)
{
  Json json = KeysInUnit(LabelJson(label, false), unit);
  json["seconds"] = label.seconds;
  return Dump(json);
}

} // namespace voxelcore
