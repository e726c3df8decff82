// Reports and labels' records read back from what CoreReport.cxx wrote.

#include "ParametersJson.h"
#include "SkeletonJson.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/JsonText.h"
#include "voxelcore/Report/CoreReport.h"

#include <nlohmann/json.hpp>

#include <optional>

namespace voxelcore
{

namespace
{

using Json = nlohmann::ordered_json;

/** As emplace(), which clang 14 does not find for a structure within a structure. */
template <typename Value>
Value &
MakeNew(std::optional<Value> & to)
{
  to = Value();
  return *to;
}

TopologyNumbers
ReadTopology(const Json & json)
{
  TopologyNumbers topology;
  json.at("euler").get_to(topology.euler);
  json.at("betti").get_to(topology.betti);
  return topology;
}

ComplexRecord
ReadComplex(const Json & json)
{
  ComplexRecord complex;
  json.at("vertices").get_to(complex.vertices);
  json.at("edges").get_to(complex.edges);
  json.at("faces").get_to(complex.faces);
  complex.topology = ReadTopology(json);
  AtLength(json, "area_mm2").get_to(complex.areaMm2);
  AtLength(json, "max_radius_mm").get_to(complex.maxRadiusMm);
  return complex;
}

InputRecord
ReadInput(const Json & json)
{
  InputRecord input;
  json.at("sha256").get_to(input.sha256);
  json.at("format").get_to(input.format);
  json.at("size").get_to(input.geometry.size);
  AtLength(json, "spacing_mm").get_to(input.geometry.spacing);
  AtLength(json, "origin_mm").get_to(input.geometry.origin);
  json.at("direction").get_to(input.geometry.direction);
  json.at("notes").get_to(input.notes);
  return input;
}

EditRecord
ReadEditRecord(const Json & json)
{
  EditRecord edits;
  json.at("cavities_filled").get_to(edits.cavitiesFilled);
  json.at("voxels_added").get_to(edits.voxelsAdded);
  json.at("components_joined").get_to(edits.componentsJoined);
  json.at("components_removed").get_to(edits.componentsRemoved);
  json.at("voxels_removed").get_to(edits.voxelsRemoved);
  for (const auto & [name, filtered] : { std::pair("median", &edits.filtered),
                                         std::pair("denoised", &edits.denoised),
                                         std::pair("changed", &edits.changed) })
  {
    if (json.contains(name))
    {
      EditRecord::Filtered & made = MakeNew(*filtered);
      json.at(name).at("voxels_added").get_to(made.voxelsAdded);
      json.at(name).at("voxels_removed").get_to(made.voxelsRemoved);
    }
  }
  if (json.contains("mended"))
  {
    const Json &         from = json.at("mended");
    EditRecord::Mended & mended = MakeNew(edits.mended);
    from.at("pieces_joined").get_to(mended.piecesJoined);
    from.at("loops_closed").get_to(mended.loopsClosed);
    from.at("cavities_filled").get_to(mended.cavitiesFilled);
    from.at("voxels_added").get_to(mended.voxelsAdded);
    from.at("voxels_removed").get_to(mended.voxelsRemoved);
  }
  for (const auto & [name, filled] : { std::pair("closed", &edits.closed),
                                       std::pair("hollows_filled", &edits.hollows),
                                       std::pair("slices_filled", &edits.slices),
                                       std::pair("torn_pieces_joined", &edits.torn) })
  {
    if (json.contains(name))
    {
      const Json &         from = json.at(name);
      EditRecord::Filled & made = MakeNew(*filled);
      from.at("holes").get_to(made.holes);
      from.at("voxels_added").get_to(made.voxelsAdded);
      from.at("components_joined").get_to(made.componentsJoined);
    }
  }
  if (json.contains("connected"))
  {
    const Json &            from = json.at("connected");
    EditRecord::Connected & connected = MakeNew(edits.connected);
    connected.closed = ReadTopology(from.at("closed_mask"));
    from.at("pieces_joined").get_to(connected.piecesJoined);
    from.at("voxels_added").get_to(connected.voxelsAdded);
    from.at("voxels_removed").get_to(connected.voxelsRemoved);
  }
  if (json.contains("touching"))
  {
    const Json &           from = json.at("touching");
    EditRecord::Touching & touching = MakeNew(edits.touching);
    from.at("pieces_joined").get_to(touching.piecesJoined);
    from.at("pieces_apart").get_to(touching.piecesApart);
    from.at("voxels_added").get_to(touching.voxelsAdded);
  }
  if (json.contains("smoothed"))
  {
    const Json &           from = json.at("smoothed");
    EditRecord::Smoothed & smoothed = MakeNew(edits.smoothed);
    from.at("voxels_added").get_to(smoothed.voxelsAdded);
    from.at("voxels_removed").get_to(smoothed.voxelsRemoved);
    from.at("largest_shift_voxels").get_to(smoothed.largestShift);
  }
  if (json.contains("topology_simplified"))
  {
    const Json &             from = json.at("topology_simplified");
    EditRecord::Simplified & simplified = MakeNew(edits.simplified);
    simplified.before = ReadTopology(from.at("before"));
    simplified.after = ReadTopology(from.at("after"));
    from.at("as_asked").get_to(simplified.asAsked);
    from.at("reason").get_to(simplified.reason);
    from.at("cuts").get_to(simplified.cuts);
    from.at("fills").get_to(simplified.fills);
    from.at("voxels_added").get_to(simplified.voxelsAdded);
    from.at("voxels_removed").get_to(simplified.voxelsRemoved);
  }
  return edits;
}

LabelRecord
ReadLabel(const Json & json)
{
  LabelRecord label;
  json.at("label").get_to(label.label);
  label.component = json.value("component", std::int64_t{ 0 });
  json.at("name").get_to(label.name);
  if (json.contains("edits"))
  {
    label.edits = ReadEditRecord(json.at("edits"));
  }
  json.at("voxels").get_to(label.voxels);
  AtLength(json, "volume_mm3").get_to(label.volumeMm3);
  json.at("bounding_box").at("lower").get_to(label.box.lower);
  json.at("bounding_box").at("size").get_to(label.box.size);
  json.at("boundary_vertices").get_to(label.boundaryVertices);
  label.shape = ReadTopology(json.at("shape"));
  label.core = ReadComplex(json.at("core"));
  for (const Json & one : json.at("pruned"))
  {
    PrunedRecord pruned;
    one.at("lambda").get_to(pruned.lambda);
    AtLength(one, "lambda_mm").get_to(pruned.lambdaMm);
    pruned.complex = ReadComplex(one);
    if (one.contains("tolerance"))
    {
      pruned.tolerance = { one.at("tolerance").get<std::string>(), AtLength(one, "tolerance_mm").get<double>(), {} };
    }
    if (one.contains("max_displacement_vox"))
    {
      pruned.refined = { one.at("mean_displacement_vox").get<double>(),
                         one.at("max_displacement_vox").get<double>(),
                         {},
                         one.value("hairs_removed", std::size_t{ 0 }) };
    }
    label.pruned.push_back(std::move(pruned));
  }
  if (json.contains("skeleton"))
  {
    label.skeleton = ReadSkeletonRecord(json.at("skeleton"));
  }
  json.at("certificate").at("topology").get_to(label.topologyEqual);
  json.at("certificate").at("enclosed").get_to(label.enclosed);
  return label;
}

/** A record with weights that are not those of its spacing tells of wrong lengths.
 *  \throws InputError, also where the lattice is one that no core is made on. */
void
RequireSoundLattice(const CoreReport & report, const std::string & where)
{
  SpacingWeights weights;
  try
  {
    weights = ComputeLatticeWeights(report.input.geometry);
  }
  catch (const InputError & error)
  {
    throw InputError(where + ": its field Provenance cannot be true: " + error.what() + ", and make the file again");
  }
  if (weights.weight != report.parameters.weights.weight)
  {
    throw InputError(where +
                     ": its field Provenance has lattice weights that its spacing does not have; make the file again");
  }
}

} // namespace

CoreReport
ParseProvenance(const std::string & text, const std::string & where)
{
  CoreReport report;
  if (text.empty())
  {
    throw InputError(where +
                     ": its field Provenance, which says how it was made and from what, is missing: a program "
                     "that saved it again left it out; give the file as VoxelCore wrote it");
  }
  try
  {
    const Json json = Json::parse(PlainJson(text));
    json.at("voxelcore").at("version").get_to(report.version);
    report.input = ReadInput(json.at("input"));
    const auto unit = UnitNamed(json.at("input").value("unit", UnitName(SpatialUnit::Millimetres)));
    if (!unit)
    {
      throw InputError("its field Provenance names no unit known here; make the file again");
    }
    report.input.geometry.unit = *unit;
    report.parameters = ReadParameters(json.at("parameters"));
    if (json.contains("skeleton"))
    {
      report.skeleton = ReadSkeletonStage(json.at("skeleton"));
    }
    for (const Json & label : json.at("labels"))
    {
      report.labels.push_back(ReadLabel(label));
    }
  }
  catch (const InputError & error)
  {
    throw InputError(where + ": " + error.what());
  }
  catch (const nlohmann::json::exception &)
  {
    throw InputError(where + ": its field Provenance is missing or damaged; make the file again with 'voxelcore core'");
  }
  RequireSoundLattice(report, where);
  return report;
}

LabelRecord
ParseLabelRecord(const std::string & text)
{
  try
  {
    const Json  json = Json::parse(text);
    LabelRecord label = ReadLabel(json);
    json.at("seconds").get_to(label.seconds);
    for (std::size_t i = 0; i < label.pruned.size(); ++i)
    {
      const Json & pruned = json.at("pruned").at(i);
      if (label.pruned[i].tolerance && !AtLength(pruned, "boundary_gap_mm").is_null())
      {
        label.pruned[i].tolerance->boundaryGapMm = AtLength(pruned, "boundary_gap_mm").get<double>();
      }
      if (label.pruned[i].tolerance && pruned.contains("boundary_gap_share"))
      {
        label.pruned[i].tolerance->boundaryGapShare = pruned.at("boundary_gap_share").get<double>();
      }
      const char * most = "max_radius_margin_mm";
      if (label.pruned[i].refined && (pruned.contains(most) || pruned.contains(InUnit(most, SpatialUnit::Voxels))))
      {
        label.pruned[i].refined->radiusMargin = MarginNumbers{ AtLength(pruned, "mean_radius_margin_mm").get<double>(),
                                                               AtLength(pruned, most).get<double>() };
      }
    }
    if (json.at("certificate").contains("covered"))
    {
      label.covered = json.at("certificate").at("covered").get<bool>();
    }
    if (json.at("certificate").contains("stand_out"))
    {
      label.standOut = json.at("certificate").at("stand_out").get<bool>();
    }
    if (label.skeleton)
    {
      label.skeleton->cuts = ReadLoopCuts(json.at("skeleton"));
      label.skeleton->border = ReadBorderNumbers(json.at("skeleton"));
    }
    return label;
  }
  catch (const nlohmann::json::exception &)
  {
    throw InputError("a label's record is damaged");
  }
}

} // namespace voxelcore
