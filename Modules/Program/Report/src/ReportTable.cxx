#include "voxelcore/Report/ReportTable.h"

#include "voxelcore/Base/LengthUnit.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/Text.h"
#include "voxelcore/Models/SkeletonModel.h"
#include "voxelcore/Models/TableColumns.h"

#include <algorithm>
#include <cstdio>

namespace voxelcore
{

namespace
{

std::size_t
Width(const std::string & text)
{
  return static_cast<std::size_t>(
    std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

/** The unit for lengths of which `lengthOf` gives one for each label. */
template <typename LengthOf>
LengthUnit
UnitOf(const CoreReport & report, LengthOf && lengthOf)
{
  double longest = 0;
  for (const LabelRecord & label : report.labels)
  {
    longest = std::max(longest, lengthOf(label));
  }
  return LengthUnit::For(longest, report.input.geometry.unit);
}

std::vector<TextColumn>
LabelColumns(const CoreReport & report)
{
  const bool              byTolerance = !report.parameters.tolerances.empty();
  std::vector<TextColumn> columns{
    { kLabelColumn.name, "", kLabelColumn.meaning },
    { kNameColumn.name, "", kNameColumn.meaning },
    { "component", "", "component of a label that was split, from 1; 0: the whole label" },
    { byTolerance ? "tolerance" : "lambda", "", "pruning of this row, as it was given" },
    { "voxels", "", "of the shape" },
    { "volume_mm3", "mm^3", "of these voxels" },
    { "vertices", "", "of the medial surface" },
    { "edges", "", "of the medial surface" },
    { "faces", "", "of the medial surface" },
    { "area_mm2", "mm^2", "of its faces" },
    { "max_radius_mm", "mm", "radius of its largest ball" },
    { "b0", "", "pieces" },
    { "b1", "", "loops" },
    { "b2", "", "cavities" },
  };
  for (TextColumn & column : columns)
  {
    column.name = InUnit(column.name, report.input.geometry.unit);
  }
  return columns;
}

} // namespace

std::string
FormatTable(const std::vector<std::vector<std::string>> & rows)
{
  std::vector<std::size_t> widths;
  for (const auto & row : rows)
  {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t column = 0; column < row.size(); ++column)
    {
      widths[column] = std::max(widths[column], Width(row[column]));
    }
  }
  std::string text;
  for (const auto & row : rows)
  {
    std::string line;
    for (std::size_t column = 0; column < row.size(); ++column)
    {
      const std::string pad(widths[column] - Width(row[column]), ' ');
      line += (column > 0 ? "  " : "") + (column == 1 ? row[column] + pad : pad + row[column]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

std::string
TopologyText(const TopologyNumbers & topology)
{
  return std::to_string(topology.euler) + "/" + std::to_string(topology.betti[0]) + "/" +
         std::to_string(topology.betti[1]) + "/" + std::to_string(topology.betti[2]);
}

std::string
ReportTable(const CoreReport & report)
{
  std::vector<std::string> head{ "label", "name", "voxels", "boundary vertices", "core faces" };
  const bool               byTolerance = !report.parameters.tolerances.empty();
  const LengthUnit         unit = UnitOf(report, [](const LabelRecord & label) {
    double gap = 0;
    for (const PrunedRecord & pruned : label.pruned)
    {
      gap = std::max(gap, pruned.tolerance ? pruned.tolerance->boundaryGapMm.value_or(0) : 0);
    }
    return gap;
  });
  const bool               hasGaps = ranges::any_of(report.labels, [](const LabelRecord & label) {
    return ranges::any_of(label.pruned, [](const PrunedRecord & pruned) {
      return pruned.tolerance && pruned.tolerance->boundaryGapMm;
    });
  });
  for (const std::string & value : byTolerance ? report.parameters.tolerances : report.parameters.lambda)
  {
    head.push_back("faces at " + value);
    if (hasGaps)
    {
      head.emplace_back("gap " + unit.Name());
    }
  }
  for (const char * title : { "shape chi/b0/b1/b2", "core chi/b0/b1/b2", "certificate", "seconds" })
  {
    head.emplace_back(title);
  }
  std::vector<std::vector<std::string>> rows{ head };
  std::uint64_t                         boundaryVertices = 0;
  for (const LabelRecord & label : report.labels)
  {
    std::vector<std::string> row{ std::to_string(label.label),
                                  label.name,
                                  std::to_string(label.voxels),
                                  std::to_string(label.boundaryVertices),
                                  std::to_string(label.core.faces) };
    for (const PrunedRecord & pruned : label.pruned)
    {
      row.push_back(std::to_string(pruned.complex.faces));
      if (hasGaps)
      {
        const auto gap = pruned.tolerance ? pruned.tolerance->boundaryGapMm : std::nullopt;
        row.push_back(gap ? unit.Text(*gap, 1, 3) : "-");
      }
    }
    row.push_back(TopologyText(label.shape));
    row.push_back(TopologyText(label.core.topology));
    row.emplace_back(label.Passed() ? "passed" : "FAILED");
    row.push_back(DecimalText(label.seconds, 2));
    rows.push_back(std::move(row));
    boundaryVertices += label.boundaryVertices;
  }
  return FormatTable(rows) + std::to_string(report.labels.size()) +
         (report.parameters.edits.splitComponents ? " component" : " label") +
         (report.labels.size() == 1 ? ", " : "s, ") + std::to_string(boundaryVertices) + " boundary vertices, " +
         DecimalText(report.seconds.total, 2) + " s, peak memory " + DecimalText(report.peakMemoryMb, 0) + " MB\n";
}

std::string
SkeletonTable(const CoreReport & report)
{
  const LengthUnit                      unit = UnitOf(report, [](const LabelRecord & label) {
    return label.skeleton ? label.skeleton->numbers.totalLength : 0.0;
  });
  std::vector<std::vector<std::string>> rows{ { "label",
                                                "name",
                                                "branches",
                                                "tips",
                                                "junctions",
                                                "cycles",
                                                "length " + unit.Name(),
                                                "mean radius " + unit.Name(),
                                                "shape chi/b0/b1/b2",
                                                "skeleton chi/b0/b1/b2",
                                                "certificate" } };
  for (const LabelRecord & label : report.labels)
  {
    if (label.skeleton)
    {
      const SkeletonNumbers & n = label.skeleton->numbers;
      rows.push_back({ std::to_string(label.label),
                       label.name,
                       std::to_string(n.branches),
                       std::to_string(n.tips),
                       std::to_string(n.junctions),
                       std::to_string(n.cycles),
                       unit.Text(n.totalLength),
                       unit.Text(n.meanRadius),
                       TopologyText(label.shape),
                       TopologyText(label.skeleton->topology),
                       label.Passed() ? "passed" : "FAILED" });
    }
  }
  return FormatTable(rows);
}

std::string
LabelTableCsv(const CoreReport & report, HeadUnits units)
{
  std::string text = HeadLine(LabelColumns(report), units);
  for (const LabelRecord & label : report.labels)
  {
    for (const PrunedRecord & pruned : label.pruned)
    {
      const ComplexRecord & complex = pruned.complex;
      char                  numbers[400];
      (void)std::snprintf(numbers,
                          sizeof(numbers),
                          "%llu,%.9g,%llu,%llu,%llu,%.9g,%.9g,%lld,%lld,%lld\n",
                          static_cast<unsigned long long>(label.voxels),
                          label.volumeMm3,
                          static_cast<unsigned long long>(complex.vertices),
                          static_cast<unsigned long long>(complex.edges),
                          static_cast<unsigned long long>(complex.faces),
                          complex.areaMm2,
                          complex.maxRadiusMm,
                          static_cast<long long>(complex.topology.betti[0]),
                          static_cast<long long>(complex.topology.betti[1]),
                          static_cast<long long>(complex.topology.betti[2]));
      text += std::to_string(label.label) + "," + CsvField(label.name) + "," + std::to_string(label.component) + "," +
              CsvField(pruned.tolerance ? pruned.tolerance->height : pruned.lambda) + "," + numbers;
    }
  }
  return text;
}

std::string
LabelTableColumnsJson(const CoreReport & report)
{
  return TablesJson({ { "labels", ColumnsJson(LabelColumns(report), report.input.geometry.unit) } });
}

} // namespace voxelcore
