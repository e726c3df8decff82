#include "voxelcore/FlowFiles.h"

#include "AppendedVtp.h"
#include "TableColumns.h"

#include "voxelcore/SkeletonModel.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numbers>
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
  { "from_node", "", "node nearer to the inlet along the tree of thickest branches; in loops flow may go either way" },
  { "to_node", "", "node at its other end" },
  { "length", "mm", "along the branch" },
  { "mean_radius", "mm", "of its sections" },
  { "min_radius", "mm", "" },
  { "max_radius", "mm", "" },
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

std::int64_t
LabelOf(const FlowSegment & segment, const std::vector<MeasuredSkeleton> & parts)
{
  const MeasuredSkeleton & part = parts[segment.part];
  return part.network ? part.graph.BranchLabel(segment.branch) : part.label;
}

/** Numbers of segments at a node, as JSON. */
std::string
ListOf(const std::vector<std::size_t> & segments)
{
  std::string list;
  for (const std::size_t segment : segments)
  {
    list += (list.empty() ? "" : ", ") + std::to_string(segment);
  }
  return "[" + list + "]";
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
  WriteVtp(path, content);
}

void
WriteFlowCsv(const std::filesystem::path &         segments,
             const std::filesystem::path &         nodes,
             const FlowNetwork &                   network,
             const std::vector<MeasuredSkeleton> & parts)
{
  TextFile file(segments, tableDigits);
  WriteHead(file, kSegmentColumns);
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
  WriteHead(ends, kNodeColumns);
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
  return "{\n  \"segments\": " + ColumnsJson(kSegmentColumns, unit) +
         ",\n  \"nodes\": " + ColumnsJson(kNodeColumns, unit) + "\n}\n";
}

void
WriteFlowJson(const std::filesystem::path &         path,
              const FlowNetwork &                   network,
              const std::vector<MeasuredSkeleton> & parts)
{
  constexpr double                      perCm = 10; // mm
  std::vector<std::vector<std::size_t>> ending(network.nodes.size());
  std::vector<std::vector<std::size_t>> beginning(network.nodes.size());
  double                                inflow = 0;
  for (std::size_t i = 0; i < network.segments.size(); ++i)
  {
    beginning[network.segments[i].from].push_back(i);
    ending[network.segments[i].to].push_back(i);
  }
  for (const FlowNode & node : network.nodes)
  {
    inflow += node.kind == FlowNodeKind::Inlet ? node.radius * node.radius : 0;
  }
  const auto nameOf = [&](std::size_t node) {
    return (network.nodes[node].kind == FlowNodeKind::Inlet ? "INLET_" : "OUTLET_") + std::to_string(node);
  };
  TextFile file(path);
  file << "{\n  \"simulation_parameters\": {\"density\": " << kDensity << ", \"viscosity\": " << kViscosity
       << ", \"number_of_cardiac_cycles\": 1, \"number_of_time_pts_per_cardiac_cycle\": 11},\n  \"vessels\": [";
  for (std::size_t i = 0; i < network.segments.size(); ++i)
  {
    const FlowSegment & segment = network.segments[i];
    file << (i > 0 ? ",\n" : "\n") << "    {\"vessel_id\": " << i << ", \"vessel_name\": \"branch" << i
         << "_seg0\", \"vessel_length\": " << segment.length / perCm
         << ", \"zero_d_element_type\": \"BloodVessel\", \"zero_d_element_values\": {\"R_poiseuille\": "
         << 8 * kViscosity / std::numbers::pi * segment.perRadius4 * perCm * perCm * perCm
         << ", \"L\": " << kDensity / std::numbers::pi * segment.perRadius2 * perCm
         << ", \"C\": 0, \"stenosis_coefficient\": 0}";
    std::string ends;
    for (const auto & [node, side] : { std::pair(segment.from, "inlet"), std::pair(segment.to, "outlet") })
    {
      if (network.nodes[node].kind != FlowNodeKind::Inner)
      {
        ends += (ends.empty() ? "\"" : ", \"") + std::string(side) + "\": \"" + nameOf(node) + "\"";
      }
    }
    if (!ends.empty())
    {
      file << ", \"boundary_conditions\": {" << ends << "}";
    }
    file << ", \"branch_id\": " << segment.branch << ", \"label\": " << LabelOf(segment, parts) << "}";
  }
  file << "\n  ],\n  \"junctions\": [";
  std::size_t junctions = 0;
  for (std::size_t node = 0; node < network.nodes.size(); ++node)
  {
    if (network.nodes[node].kind == FlowNodeKind::Inner)
    {
      file << (junctions > 0 ? ",\n" : "\n") << "    {\"junction_name\": \"J" << junctions
           << "\", \"junction_type\": \"NORMAL_JUNCTION\", \"inlet_vessels\": " << ListOf(ending[node])
           << ", \"outlet_vessels\": " << ListOf(beginning[node]) << "}";
      ++junctions;
    }
  }
  file << "\n  ],\n  \"boundary_conditions\": [";
  bool isFirst = true;
  for (std::size_t node = 0; node < network.nodes.size(); ++node)
  {
    const FlowNode & end = network.nodes[node];
    if (end.kind != FlowNodeKind::Inner)
    {
      const bool   isInlet = end.kind == FlowNodeKind::Inlet;
      const double value = isInlet ? end.radius * end.radius / inflow : 0;
      file << (isFirst ? "\n" : ",\n") << "    {\"bc_name\": \"" << nameOf(node) << "\", \"bc_type\": \""
           << (isInlet ? "FLOW" : "PRESSURE") << "\", \"bc_values\": {\"" << (isInlet ? "Q" : "P") << "\": [" << value
           << ", " << value << "], \"t\": [0, 1]}}";
      isFirst = false;
    }
  }
  file << "\n  ]\n}\n";
  file.Finish();
}

} // namespace voxelcore
