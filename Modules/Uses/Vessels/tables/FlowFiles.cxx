#include "voxelcore/Vessels/FlowFiles.h"

#include "voxelcore/Base/Library.h"
#include "voxelcore/Models/AppendedVtp.h"
#include "voxelcore/Models/TableColumns.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Text.h"
#include "voxelcore/Models/SkeletonModel.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <utility>

namespace voxelcore
{

namespace
{

constexpr auto kSegmentColumns = std::to_array<Column>({
  { "segment", "", "number of the segment, from 0" },
  kLabelColumn,
  kNameColumn,
  kPartColumn,
  kBranchIdColumn,
  { "from_node", "", "node nearer to the inlet; in loops flow may go either way" },
  { "to_node", "", "node at its other end" },
  { "length", "mm", "along the branch" },
  { "mean_radius", "mm", "mean of its sections" },
  { "min_radius", "mm", "least of them" },
  { "max_radius", "mm", "greatest of them" },
  { "poiseuille_radius", "mm", "of the even pipe of the same length and resistance" },
  { "resistance_per_viscosity", "mm^-3", "8 / pi times the integral of 1 / radius^4 along it" },
});

constexpr auto kNodeColumns = std::to_array<Column>({
  { "node", "", "number of the node, from 0" },
  { "kind", "", "inlet, outlet or inner" },
  { "x", "mm", "place, LPS" },
  { "y", "mm", "" },
  { "z", "mm", "" },
  { "radius", "mm", "of the section there" },
});

constexpr double kDensity = 1.06;   // of blood, g/cm^3
constexpr double kViscosity = 0.04; // of blood, g/(cm s)

// Examples that users put their own in for.
constexpr double kYoungsModulus = 4e5; // of an artery's wall, Pa
constexpr double kInflow = 1e-6;       // m^3/s

std::int64_t
LabelOf(const FlowSegment & segment, const std::vector<MeasuredSkeleton> & parts)
{
  const MeasuredSkeleton & part = parts[segment.part];
  return part.network ? part.graph.BranchLabel(segment.branch) : part.label;
}

struct NodeSegments
{
  std::vector<std::size_t> ending;
  std::vector<std::size_t> beginning;
};

std::vector<NodeSegments>
SegmentsAtNodes(const FlowNetwork & network)
{
  std::vector<NodeSegments> at(network.nodes.size());
  for (std::size_t i = 0; i < network.segments.size(); ++i)
  {
    at[network.segments[i].from].beginning.push_back(i);
    at[network.segments[i].to].ending.push_back(i);
  }
  return at;
}

/** A node's number in files of openBF, where the inlet is 1. */
std::vector<std::size_t>
OpenBfNumbers(const FlowNetwork & network)
{
  std::vector<std::size_t> numbers(network.nodes.size());
  std::size_t              next = 2;
  for (std::size_t node = 0; node < numbers.size(); ++node)
  {
    numbers[node] = network.nodes[node].kind == FlowNodeKind::Inlet ? 1 : next++;
  }
  return numbers;
}

/** What openBF cannot have. */
void
RequireOpenBf(const FlowNetwork & network, const std::vector<NodeSegments> & at)
{
  const auto        inlets = ranges::count(network.nodes, FlowNodeKind::Inlet, &FlowNode::kind);
  const std::string other = "; give a .csv file, or a .json file for svZeroDSolver";
  if (inlets != 1)
  {
    throw InputError("openBF takes a network with one inlet, and this one has " + std::to_string(inlets) + other +
                     ", or choose one label in one piece");
  }
  for (std::size_t node = 0; node < at.size(); ++node)
  {
    const auto & [ending, beginning] = at[node];
    const bool isFit = network.nodes[node].kind != FlowNodeKind::Inner ||
                       (!ending.empty() && !beginning.empty() && ending.size() + beginning.size() <= 3);
    if (!isFit)
    {
      const Vector3 & place = network.nodes[node].place;
      throw InputError(
        "openBF takes two or three vessels at a junction, of which one leads in and "
        "one out; there are " +
        std::to_string(ending.size()) + " in and " + std::to_string(beginning.size()) + " out at " +
        FixedText(place[0]) + ", " + FixedText(place[1]) + ", " + FixedText(place[2]) + " (LPS mm)" + other);
    }
  }
}

} // namespace

void
WriteCenterlineVtp(const std::filesystem::path & path, const std::vector<CenterlineTract> & tracts, SpatialUnit unit)
{
  VtpContent                               content;
  std::vector<double>                      radius;
  std::array<std::vector<std::int64_t>, 5> numbers;
  VtpCells &                               lines = content.cells[1];
  for (const CenterlineTract & tract : tracts)
  {
    for (const Vector3 & place : tract.places)
    {
      lines.points.push_back(static_cast<std::int64_t>(content.positions.size() / 3));
      content.positions.insert(content.positions.end(), place.begin(), place.end());
    }
    lines.offsets.push_back(static_cast<std::int64_t>(lines.points.size()));
    radius.insert(radius.end(), tract.radius.begin(), tract.radius.end());
    const std::array<std::int64_t, 5> values{ tract.centerline,
                                              tract.tract,
                                              tract.group,
                                              tract.isBlanked ? 1 : 0,
                                              tract.label };
    for (std::size_t k = 0; k < values.size(); ++k)
    {
      numbers[k].push_back(values[k]);
    }
  }
  content.texts = { { "SPACE", "LPS" }, { "Units", UnitName(unit) } };
  content.pointArrays.emplace_back("MaximumInscribedSphereRadius", std::move(radius));
  constexpr std::array<const char *, 5> names{ "CenterlineIds", "TractIds", "GroupIds", "Blanking", "Label" };
  for (std::size_t k = 0; k < names.size(); ++k)
  {
    content.cellArrays.emplace_back(names[k], std::move(numbers[k]));
  }
  WriteVtp(path, std::move(content));
}

void
WriteFlowCsv(const std::filesystem::path &         segments,
             const std::filesystem::path &         nodes,
             const FlowNetwork &                   network,
             const std::vector<MeasuredSkeleton> & parts,
             HeadUnits                             units)
{
  TextFile file(segments, tableDigits);
  file << HeadLine(kSegmentColumns, units);
  for (std::size_t i = 0; i < network.segments.size(); ++i)
  {
    const FlowSegment &      segment = network.segments[i];
    const MeasuredSkeleton & part = parts[segment.part];
    const std::int64_t       label = LabelOf(segment, parts);
    file << i << "," << label << "," << CsvField(part.network ? part.network->NameOf(label) : part.name) << ","
         << part.component << "," << segment.branch << "," << segment.from << "," << segment.to;
    for (const double number : { segment.length,
                                 segment.meanRadius,
                                 segment.leastRadius,
                                 segment.greatestRadius,
                                 segment.PoiseuilleRadius(),
                                 8 / std::numbers::pi * segment.perRadius4 })
    {
      file << "," << number;
    }
    file << "\n";
  }
  file.Finish();
  TextFile ends(nodes, tableDigits);
  ends << HeadLine(kNodeColumns, units);
  for (std::size_t i = 0; i < network.nodes.size(); ++i)
  {
    const FlowNode & node = network.nodes[i];
    const char *     kind = node.kind == FlowNodeKind::Inlet    ? "inlet"
                            : node.kind == FlowNodeKind::Outlet ? "outlet"
                                                                : "inner";
    ends << i << "," << kind;
    for (const double number : { node.place[0], node.place[1], node.place[2], node.radius })
    {
      ends << "," << number;
    }
    ends << "\n";
  }
  ends.Finish();
}

std::string
FlowColumnsJson(SpatialUnit unit)
{
  return TablesJson(
    { { "segments", ColumnsJson(kSegmentColumns, unit) }, { "nodes", ColumnsJson(kNodeColumns, unit) } });
}

void
WriteFlowJson(const std::filesystem::path &         path,
              const FlowNetwork &                   network,
              const std::vector<MeasuredSkeleton> & parts)
{
  using Json = nlohmann::ordered_json;
  constexpr double perCm = 10; // mm
  const auto       at = SegmentsAtNodes(network);
  double           inflow = 0;
  for (const FlowNode & node : network.nodes)
  {
    inflow += node.kind == FlowNodeKind::Inlet ? node.radius * node.radius : 0;
  }
  const auto nameOf = [&](std::size_t node) {
    return (network.nodes[node].kind == FlowNodeKind::Inlet ? "INLET_" : "OUTLET_") + std::to_string(node);
  };
  Json vessels = Json::array();
  for (std::size_t i = 0; i < network.segments.size(); ++i)
  {
    const FlowSegment & segment = network.segments[i];
    const double        resistance = 8 * kViscosity / std::numbers::pi * segment.perRadius4 * perCm * perCm * perCm;
    Json                vessel = {
                     { "vessel_id", i },
                     { "vessel_name", "branch" + std::to_string(i) + "_seg0" },
                     { "vessel_length", segment.length / perCm },
                     { "zero_d_element_type", "BloodVessel" },
                     { "zero_d_element_values",
                       { { "R_poiseuille", resistance },
                         { "L", kDensity / std::numbers::pi * segment.perRadius2 * perCm },
                         { "C", 0.0 },
                         { "stenosis_coefficient", 0.0 } } },
    };
    for (const auto & [node, side] : { std::pair(segment.from, "inlet"), std::pair(segment.to, "outlet") })
    {
      if (network.nodes[node].kind != FlowNodeKind::Inner)
      {
        vessel["boundary_conditions"][side] = nameOf(node);
      }
    }
    vessel["branch_id"] = segment.branch;
    vessel["label"] = LabelOf(segment, parts);
    vessels.push_back(std::move(vessel));
  }
  Json junctions = Json::array();
  Json conditions = Json::array();
  for (std::size_t i = 0; i < network.nodes.size(); ++i)
  {
    const FlowNode & node = network.nodes[i];
    if (node.kind == FlowNodeKind::Inner)
    {
      junctions.push_back({ { "junction_name", "J" + std::to_string(junctions.size()) },
                            { "junction_type", "NORMAL_JUNCTION" },
                            { "inlet_vessels", at[i].ending },
                            { "outlet_vessels", at[i].beginning } });
      continue;
    }
    const bool   isInlet = node.kind == FlowNodeKind::Inlet;
    const double value = isInlet ? node.radius * node.radius / inflow : 0;
    conditions.push_back({ { "bc_name", nameOf(i) },
                           { "bc_type", isInlet ? "FLOW" : "PRESSURE" },
                           { "bc_values", { { isInlet ? "Q" : "P", { value, value } }, { "t", { 0.0, 1.0 } } } } });
  }
  const Json json = { { "simulation_parameters",
                        { { "density", kDensity },
                          { "viscosity", kViscosity },
                          { "number_of_cardiac_cycles", 1 },
                          { "number_of_time_pts_per_cardiac_cycle", 11 } } },
                      { "vessels", std::move(vessels) },
                      { "junctions", std::move(junctions) },
                      { "boundary_conditions", std::move(conditions) } };
  TextFile   file(path);
  file << json.dump(2) << "\n";
  file.Finish();
}

void
WriteFlowYaml(const std::filesystem::path &         path,
              const std::filesystem::path &         inlet,
              const std::string &                   name,
              const FlowNetwork &                   network,
              const std::vector<MeasuredSkeleton> & parts)
{
  constexpr double perMetre = 1000; // mm
  constexpr int    kDecimals = 9;   // nm; in fixed form, as 1e-6 is a text in YAML 1.1
  const auto       at = SegmentsAtNodes(network);
  RequireOpenBf(network, at);
  const auto                                    numbers = OpenBfNumbers(network);
  std::size_t                                   next = numbers.size() + 1;
  std::set<std::pair<std::size_t, std::size_t>> taken;
  TextFile                                      file(path);
  const auto                                    quoted = [](const std::string & text) { // as JSON is YAML, too
    return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  };
  file << "project_name: " << quoted(name) << "\ninlet_file: " << quoted(name + "_inlet.dat")
       << "\nwrite_results: [\"P\", \"Q\"]\n\nsolver:\n  Ccfl: 0.9\n  cycles: 100\n"
       << "  convergence_tolerance: 1.0\n  jump: 100\n\nblood:\n  rho: " << FixedText(1000 * kDensity, 1)
       << "\n  mu: " << FixedText(kViscosity / 10, 4) << "\n\nnetwork:\n";
  for (std::size_t i = 0; i < network.segments.size(); ++i)
  {
    const FlowSegment & segment = network.segments[i];
    const auto          write = [&](const char * ending, std::size_t from, std::size_t to, double length) {
      file << "  - label: \"segment" << i << ending << "\" # label " << LabelOf(segment, parts) << ", branch_id "
           << segment.branch << "\n    sn: " << from << "\n    tn: " << to
           << "\n    L: " << FixedText(length / perMetre, kDecimals)
           << "\n    R0: " << FixedText(segment.PoiseuilleRadius() / perMetre, kDecimals)
           << "\n    E: " << FixedText(kYoungsModulus, 1) << "\n";
    };
    const std::size_t from = numbers[segment.from];
    const std::size_t to = numbers[segment.to];
    if (taken.insert({ from, to }).second)
    {
      write("", from, to, segment.length);
    }
    else // openBF knows vessels by their nodes
    {
      write("a", from, next, segment.length / 2);
      write("b", next, to, segment.length / 2);
      ++next;
    }
    if (network.nodes[segment.to].kind == FlowNodeKind::Outlet)
    {
      file << "    Rt: 0.0\n";
    }
  }
  file.Finish();
  TextFile flow(inlet);
  flow << "0.0 " << kInflow << "\n1.0 " << kInflow << "\n";
  flow.Finish();
}

} // namespace voxelcore
