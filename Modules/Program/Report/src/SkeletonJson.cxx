#include "SkeletonJson.h"

#include "voxelcore/Base/SpatialUnit.h"
#include "voxelcore/Report/SkeletonTexts.h"
#include "voxelcore/Vessels/SectionTables.h"

#include <cmath>

namespace voxelcore
{

namespace
{

using Json = nlohmann::ordered_json;

Json
LengthJson(const std::optional<Lambda> & length)
{
  return length ? Json(length->text) : Json(nullptr);
}

std::optional<Lambda>
ReadLength(const Json & json)
{
  return json.is_null() ? std::nullopt : std::optional<Lambda>(ParseLambda(json.get<std::string>()));
}

/** How many ends lie in the border, and the sections of the body there. Centres are indices of voxels. */
Json
BorderJson(const BorderNumbers & border)
{
  Json json{ { "ends", border.ends }, { "sections", Json::array() } };
  for (const BorderSection & section : border.sections)
  {
    const Vector3 & at = section.centre;
    json["sections"].push_back({ { "side", BorderSideText(section) },
                                 { "cut", section.isCut },
                                 { "voxels", section.voxels },
                                 { "centre_index", { at[0] - 0.5, at[1] - 0.5, at[2] - 0.5 } },
                                 { "radius_mm", section.radius } });
  }
  return json;
}

Json
NetworkJson(const SkeletonNetwork & network)
{
  Json json{ { "labels", Json::array() }, { "contacts", Json::array() }, { "gaps", Json::array() } };
  for (const NetworkLabel & label : network.labels)
  {
    json["labels"].push_back({ { "label", label.value },
                               { "name", label.name },
                               { "voxels", label.voxels },
                               { "volume_mm3", label.volumeMm3 } });
  }
  for (const NetworkContact & contact : network.contacts)
  {
    json["contacts"].push_back({ { "labels", contact.labels },
                                 { "voxels", contact.voxels },
                                 { "faces", contact.faces },
                                 { "area_mm2", contact.areaMm2 },
                                 { "centre_mm", contact.centre },
                                 { "nodes_mm", contact.places } });
  }
  for (const NetworkGap & gap : network.gaps)
  {
    json["gaps"].push_back({ { "labels", gap.labels }, { "node_mm", gap.place } });
  }
  return json;
}

SkeletonNetwork
ReadNetwork(const Json & json)
{
  SkeletonNetwork network;
  for (const Json & one : json.at("labels"))
  {
    NetworkLabel & label = network.labels.emplace_back();
    one.at("label").get_to(label.value);
    one.at("name").get_to(label.name);
    one.at("voxels").get_to(label.voxels);
    AtLength(one, "volume_mm3").get_to(label.volumeMm3);
  }
  for (const Json & one : json.at("contacts"))
  {
    NetworkContact & contact = network.contacts.emplace_back();
    one.at("labels").get_to(contact.labels);
    one.at("voxels").get_to(contact.voxels);
    one.at("faces").get_to(contact.faces);
    AtLength(one, "area_mm2").get_to(contact.areaMm2);
    AtLength(one, "centre_mm").get_to(contact.centre);
    AtLength(one, "nodes_mm").get_to(contact.places);
  }
  for (const Json & one : json.at("gaps"))
  {
    NetworkGap & gap = network.gaps.emplace_back();
    one.at("labels").get_to(gap.labels);
    AtLength(one, "node_mm").get_to(gap.place);
  }
  return network;
}

Json
LesionsJson(const std::vector<VesselLesion> & lesions)
{
  Json       json = Json::array();
  const auto number = [](double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); };
  for (const VesselLesion & one : lesions)
  {
    Json lesion{ { "kind", LesionText(one.kind) },
                 { "branch_id", one.branch },
                 { "arc_length_mm", one.arc },
                 { "place_mm", one.place },
                 { "length_mm", one.end - one.begin },
                 { "diameter_mm", one.diameter },
                 { "reference_diameter_mm", number(one.reference) } };
    if (one.kind == LesionKind::Dome)
    {
      lesion["neck_width_mm"] = one.neckWidth;
      lesion["dome_height_mm"] = one.height;
      lesion["dome_volume_mm3"] = one.volume;
      lesion["aspect_ratio"] = number(one.AspectRatio());
    }
    else
    {
      lesion["degree_by_diameter_percent"] = 100 * one.DegreeByDiameter();
      lesion["degree_by_area_percent"] = 100 * one.DegreeByArea();
    }
    json.push_back(lesion);
  }
  return json;
}

} // namespace

Json
SkeletonStageJson(const SkeletonRequest & stage)
{
  const BranchRequest & branches = stage.branches;
  Json                  json{ { "lambda", stage.lambda.text },
             { "stand_out", stage.standOut.text },
             { "plates", LengthJson(stage.plates) },
             { "smooth", stage.smooth.text },
             { "prune_branches", LengthJson(branches.pruneLength) },
             { "prune_branches_radii", branches.pruneRadii },
             { "cut_loops", branches.cutLoops },
             { "split_at_junctions", branches.splitAtJunctions },
             { "root", RootText(branches.root) } };
  if (!branches.realLoops.empty())
  {
    json["real_loops"] = branches.realLoops;
  }
  if (stage.tolerance)
  {
    json["tolerance"] = stage.tolerance->text;
  }
  if (stage.refined)
  {
    json["refined"] = true;
  }
  if (stage.border != BorderEnds::Closed)
  {
    json["border"] = BorderText(stage.border);
  }
  if (stage.network)
  {
    json["network"] = true;
  }
  return json;
}

SkeletonRequest
ReadSkeletonStage(const Json & json)
{
  SkeletonRequest stage;
  stage.lambda = ParseLambda(json.at("lambda").get<std::string>());
  if (json.contains("tolerance"))
  {
    stage.tolerance = ParseTolerance(json.at("tolerance").get<std::string>());
  }
  stage.refined = json.value("refined", false);
  stage.border = ParseBorder(json.value("border", BorderText(BorderEnds::Closed)));
  stage.network = json.value("network", false);
  stage.standOut = ParseLambda(json.at("stand_out").get<std::string>());
  stage.plates = ReadLength(json.at("plates"));
  stage.smooth = ParseLambda(json.at("smooth").get<std::string>());
  stage.branches.pruneLength = ReadLength(json.at("prune_branches"));
  json.at("prune_branches_radii").get_to(stage.branches.pruneRadii);
  json.at("cut_loops").get_to(stage.branches.cutLoops);
  json.at("split_at_junctions").get_to(stage.branches.splitAtJunctions);
  stage.branches.realLoops = json.value("real_loops", stage.branches.realLoops);
  stage.branches.root = ParseRoot(json.at("root").get<std::string>());
  return stage;
}

Json
SkeletonRecordJson(const SkeletonRecord & skeleton, bool inFile)
{
  const SkeletonNumbers & n = skeleton.numbers;
  Json                    json = { { "euler", skeleton.topology.euler },
                                   { "betti", skeleton.topology.betti },
                                   { "components", n.components },
                                   { "branches", n.branches },
                                   { "tips", n.tips },
                                   { "junctions", n.junctions },
                                   { "cycles", n.cycles },
                                   { "isolated_loops", n.isolatedLoops },
                                   { "isolated_points", n.isolatedPoints },
                                   { "closed_faces", n.closedFaces },
                                   { "plate_faces", n.plateFaces },
                                   { "total_length_mm", n.totalLength },
                                   { "mean_length_mm", n.meanLength },
                                   { "max_length_mm", n.maxLength },
                                   { "mean_radius_mm", n.meanRadius },
                                   { "volume_mm3", n.volume },
                                   { "surface_mm2", n.surface } };
  json["cuts"] = Json::array();
  for (const LoopCut & cut : skeleton.cuts)
  {
    json["cuts"].push_back({ { "position_mm", cut.position }, { "radius_mm", cut.radius } });
  }
  if (skeleton.border)
  {
    json["border"] = BorderJson(*skeleton.border);
  }
  if (skeleton.network)
  {
    json["network"] = NetworkJson(*skeleton.network);
  }
  if (!inFile)
  {
    if (skeleton.lesions)
    {
      json["lesions"] = LesionsJson(*skeleton.lesions);
    }
    json["output"] = skeleton.output;
  }
  return json;
}

std::vector<LoopCut>
ReadLoopCuts(const Json & json)
{
  std::vector<LoopCut> cuts;
  for (const Json & one : json.at("cuts"))
  {
    LoopCut & cut = cuts.emplace_back();
    AtLength(one, "position_mm").get_to(cut.position);
    AtLength(one, "radius_mm").get_to(cut.radius);
  }
  return cuts;
}

std::optional<BorderNumbers>
ReadBorderNumbers(const Json & json)
{
  if (!json.contains("border"))
  {
    return std::nullopt;
  }
  BorderNumbers border;
  json.at("border").at("ends").get_to(border.ends);
  for (const Json & one : json.at("border").at("sections"))
  {
    BorderSection &   section = border.sections.emplace_back();
    const std::string side = one.at("side").get<std::string>();
    section.axis = side.starts_with('i') ? 0 : side.starts_with('j') ? 1 : 2;
    section.isUpper = side.ends_with('+');
    one.at("cut").get_to(section.isCut);
    one.at("voxels").get_to(section.voxels);
    one.at("centre_index").get_to(section.centre);
    section.centre = { section.centre[0] + 0.5, section.centre[1] + 0.5, section.centre[2] + 0.5 };
    AtLength(one, "radius_mm").get_to(section.radius);
  }
  return border;
}

SkeletonRecord
ReadSkeletonRecord(const Json & json)
{
  SkeletonRecord skeleton;
  json.at("euler").get_to(skeleton.topology.euler);
  json.at("betti").get_to(skeleton.topology.betti);
  if (json.contains("network"))
  {
    skeleton.network = ReadNetwork(json.at("network"));
  }
  return skeleton;
}

} // namespace voxelcore
