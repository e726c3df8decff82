#include "voxelcore/Compare/CompareTables.h"

#include "TablesJson.h"

#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/Text.h"
#include "voxelcore/Models/SkeletonModel.h"
#include "voxelcore/Models/TableColumns.h"
#include "voxelcore/Report/ReportTable.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace voxelcore
{

namespace
{

using Json = nlohmann::ordered_json;

constexpr std::array<Column, 2> kLabelColumns{ kLabelColumn, kNameColumn };

constexpr auto kMaskColumns = std::to_array<Column>({
  { "voxels_a", "", "of A" },
  { "voxels_b", "", "of B" },
  { "voxels_both", "", "in A and in B" },
  { "volume_a", "mm3", "of A's voxels" },
  { "volume_b", "mm3", "of B's voxels" },
  { "dice", "1", "2 both / (A + B)" },
  { "jaccard", "1", "both / (A or B)" },
  { "missing_ratio", "1", "voxels of A that B lacks, of A's (ATM'22: AMR)" },
  { "leakage_ratio", "1", "voxels of B that A lacks, of A's" },
  { "hausdorff", "mm", "greatest distance from the centre of a boundary voxel to the other's nearest" },
  { "hausdorff_95", "mm", "95th percentile of these distances, the greater of both directions" },
  { "mean_distance", "mm", "mean of these distances, over the boundary voxels of both" },
});

constexpr auto kLineColumns = std::to_array<Column>({
  { "cl_dice", "1", "harmonic mean of the next two (Shit et al. 2021), of certified skeletons" },
  { "topology_precision", "1", "share of B's skeleton voxels that A has" },
  { "topology_sensitivity", "1", "share of A's skeleton voxels that B has" },
  { "tree_length", "mm", "of A's skeleton" },
  { "tree_length_detected", "1", "share of it in B's voxels (ATM'22: TD)" },
  { "branches", "", "of A's skeleton" },
  { "branches_detected", "1", "share of them with 80 % of their length in B's voxels (ATM'22: BD)" },
});

constexpr auto kPartColumns = std::to_array<Column>({
  { "kind", "", "piece (26-connected), loop or cavity (6-connected)" },
  { "change",
    "",
    "missed: B has nothing of it; invented: A has nothing of it; broken: a piece of B beside another that shares more "
    "with the same one of A; joined: the same with A and B exchanged; loops are missed or invented where the line "
    "around them leaves the other mask" },
  { "voxels", "", "of the part; of a loop those of its line that the other mask lacks" },
  { "i", "", "voxel in its middle, from 0" },
  { "j", "", "" },
  { "k", "", "" },
  { "x", "mm", "centre of that voxel, LPS" },
  { "y", "mm", "" },
  { "z", "mm", "" },
});

constexpr auto kTreeColumns = std::to_array<Column>({
  { "length_a", "mm", "of A's branches" },
  { "length_b", "mm", "of B's branches" },
  { "length_difference", "mm", "of B less that of A" },
  { "tree_length_detected", "1", "share of A's length within the tolerance of B (ATM'22: TD, DLR)" },
  { "branches_a", "", "of A" },
  { "branches_b", "", "of B" },
  { "branches_detected", "1", "share of A's branches of which one connected run of B follows 80 % (ATM'22: BD)" },
  { "branches_invented", "", "of B, of which no connected run of A follows 80 %" },
  { "leakage", "mm", "length of B that is not within the tolerance of A" },
  { "leakage_ratio", "1", "the same, of A's length" },
  { "tips_found", "", "with a partner within the tolerance" },
  { "tips_missed", "", "of A without a partner" },
  { "tips_invented", "", "of B without a partner" },
  { "tip_distance", "mm", "mean over those found" },
  { "bifurcations_found", "", "with a partner within the tolerance" },
  { "bifurcations_missed", "", "of A without a partner" },
  { "bifurcations_invented", "", "of B without a partner" },
  { "bifurcation_distance", "mm", "mean over those found" },
  { "angle_error", "deg", "how much angles between branches differ, mean over bifurcations found" },
  { "axis_distance", "mm", "mean distance of the axes, of places of both that are found" },
  { "axis_distance_95", "mm", "95th percentile" },
  { "axis_distance_max", "mm", "greatest" },
  { "hausdorff", "mm", "greatest distance of a place of either to the other's lines" },
  { "radius_bias", "mm", "radius of B less that of A, mean over A's length that is found" },
  { "radius_error", "mm", "the same without sign" },
});

constexpr auto kPlaceColumns = std::to_array<Column>({
  { "kind", "", "tip or bifurcation" },
  { "change", "", "found, missed (only A has it) or invented (only B has it)" },
  { "x", "mm", "place in A, of an invented one in B; LPS" },
  { "y", "mm", "" },
  { "z", "mm", "" },
  { "radius", "mm", "there" },
  { "distance", "mm", "to its partner" },
  { "angle_error", "deg", "of a bifurcation: how much angles between its branches differ, mean over every two" },
});

constexpr auto kBranchColumns = std::to_array<Column>({
  { "side", "", "A or B" },
  kBranchIdColumn,
  { "length", "mm", "of the branch" },
  { "found_length", "mm", "of it within the tolerance of the other" },
  { "share", "1", "of its length that one connected run of the other follows" },
  { "found", "", "1: that is 80 % or more" },
});

constexpr auto kLevelColumns = std::to_array<Column>({
  { "level", "", "0: the axis from the root, 1: its laterals, ..." },
  { "axes_a", "", "of A" },
  { "axes_b", "", "of B" },
  { "length_a", "mm", "of A's axes" },
  { "length_b", "mm", "of B's axes" },
});

constexpr auto kCoreColumns = std::to_array<Column>({
  { "hausdorff", "mm", "greatest distance from a vertex of either to the other surface" },
  { "hausdorff_95", "mm", "95th percentile of these distances, the greater of both directions" },
  { "mean_distance", "mm", "mean of these distances, over the vertices of both" },
  { "coverage_a", "1", "share of A's vertices within the tolerance of B" },
  { "coverage_b", "1", "share of B's vertices within the tolerance of A" },
});

template <typename TColumns>
void
AddColumns(CompareTable & table, const TColumns & columns, SpatialUnit unit)
{
  for (const Column & column : columns)
  {
    table.columns.push_back({ column.name, InUnit(column.unit, unit), column.meaning });
  }
}

template <typename TColumns>
CompareTable
TableWith(const char * name, const TColumns & columns, SpatialUnit unit)
{
  CompareTable table;
  table.name = name;
  AddColumns(table, kLabelColumns, unit);
  AddColumns(table, columns, unit);
  return table;
}

/** A row as it grows. */
class Row
{
public:
  explicit Row(const ComparedLabel & label)
    : m_Cells{ label.label, label.name }
  {}
  template <typename TValue>
  Row &
  operator<<(const TValue & value)
  {
    if constexpr (std::is_floating_point_v<TValue>)
    {
      m_Cells.push_back(std::isfinite(value) ? CompareCell(value) : CompareCell());
    }
    else if constexpr (std::is_integral_v<TValue>)
    {
      m_Cells.emplace_back(static_cast<std::int64_t>(value));
    }
    else
    {
      m_Cells.emplace_back(std::string(value));
    }
    return *this;
  }
  Row &
  operator<<(const Vector3 & place)
  {
    return *this << place[0] << place[1] << place[2];
  }

  void
  AddTo(CompareTable & table)
  {
    if (m_Cells.size() != table.columns.size())
    {
      throw std::logic_error("a row of the table " + table.name + " does not have its columns");
    }
    table.rows.push_back(std::move(m_Cells));
  }

private:
  std::vector<CompareCell> m_Cells;
};

void
AddTopology(Row & row, const TopologyComparison & topology)
{
  for (const auto & numbers : { topology.a.betti, topology.b.betti, topology.errors })
  {
    for (const std::int64_t number : numbers)
    {
      row << number;
    }
  }
}

constexpr std::array<PartKind, 3>   kKinds{ PartKind::Piece, PartKind::Loop, PartKind::Cavity };
constexpr std::array<PartChange, 4> kChanges{ PartChange::Missed,
                                              PartChange::Invented,
                                              PartChange::Broken,
                                              PartChange::Joined };

/** Over those where there is one. */
double
MeanOf(const std::vector<PlaceMatch> & places, double PlaceMatch::*number)
{
  double      sum = 0;
  std::size_t count = 0;
  for (const PlaceMatch & place : places)
  {
    if (!std::isnan(place.*number))
    {
      sum += place.*number;
      ++count;
    }
  }
  return count == 0 ? std::nan("") : sum / static_cast<double>(count);
}

std::string
CellText(const CompareCell & cell)
{
  if (const auto * number = std::get_if<std::int64_t>(&cell))
  {
    return std::to_string(*number);
  }
  if (const auto * real = std::get_if<double>(&cell))
  {
    return FixedText(*real, 3);
  }
  const auto * text = std::get_if<std::string>(&cell);
  return text != nullptr ? *text : "-";
}

} // namespace

std::vector<CompareTable>
TablesOf(const std::vector<ComparedMasks> & labels, const ImageGeometry & geometry)
{
  CompareTable all = TableWith("labels", kMaskColumns, geometry.unit);
  for (const char * connectivity : { "6", "26" })
  {
    for (const char * side : { "_a", "_b", "_error" })
    {
      for (const char * number : { "0", "1", "2" })
      {
        const std::string what = std::array{ "pieces", "loops", "cavities" }[static_cast<std::size_t>(number[0] - '0')];
        all.columns.push_back({ std::string("b") + number + side + "_" + connectivity,
                                "",
                                what + ", " + connectivity + "-connected: " +
                                  (side[1] == 'a'   ? "of A"
                                   : side[1] == 'b' ? "of B"
                                                    : "difference") });
      }
    }
  }
  for (const PartKind kind : kKinds)
  {
    for (const PartChange change : kChanges)
    {
      if (kind != PartKind::Loop || change == PartChange::Missed || change == PartChange::Invented)
      {
        const std::string plural = kind == PartKind::Cavity ? "cavities" : NameOf(kind) + std::string("s");
        all.columns.push_back({ plural + "_" + NameOf(change), "", "in the table of differences: their number" });
      }
    }
  }
  AddColumns(all, kLineColumns, geometry.unit);
  CompareTable parts = TableWith("differences", kPartColumns, geometry.unit);
  const double voxel = geometry.spacing[0] * geometry.spacing[1] * geometry.spacing[2];
  for (const ComparedMasks & one : labels)
  {
    Row row(one);
    row << one.overlap.a << one.overlap.b << one.overlap.both << static_cast<double>(one.overlap.a) * voxel
        << static_cast<double>(one.overlap.b) * voxel << one.overlap.Dice() << one.overlap.Jaccard()
        << one.overlap.MissingRatio() << one.overlap.LeakageRatio() << one.surface.hausdorff << one.surface.percentile95
        << one.surface.mean;
    AddTopology(row, one.open);
    AddTopology(row, one.closed);
    for (const PartKind kind : kKinds)
    {
      for (const PartChange change : kChanges)
      {
        const auto count = ranges::count_if(one.parts, [&](const DifferingPart & part) {
          return part.kind == kind && part.change == change;
        });
        if (kind != PartKind::Loop)
        {
          row << count;
        }
        else if (change == PartChange::Missed || change == PartChange::Invented)
        {
          row << (one.lines ? static_cast<double>(count) : std::nan(""));
        }
      }
    }
    if (one.lines)
    {
      const CentrelineOverlap & ofA = one.lines->at(0);
      const CentrelineOverlap & ofB = one.lines->at(1);
      row << ClDice(ofA, ofB) << ofB.VoxelShare() << ofA.VoxelShare() << ofA.length << ofA.LengthShare() << ofA.branches
          << ofA.BranchShare();
    }
    else
    {
      for (std::size_t k = 0; k < kLineColumns.size(); ++k)
      {
        row << std::nan("");
      }
    }
    row.AddTo(all);
    for (const DifferingPart & part : one.parts)
    {
      const auto & [i, j, k] = part.place;
      Row place(one);
      place << NameOf(part.kind) << NameOf(part.change) << part.voxels << i << j << k
            << LatticeToPhysical(geometry, { i + 0.5, j + 0.5, k + 0.5 });
      place.AddTo(parts);
    }
  }
  return { std::move(all), std::move(parts) };
}

std::vector<CompareTable>
TablesOf(const std::vector<ComparedTrees> & labels, SpatialUnit unit)
{
  CompareTable all = TableWith("labels", kTreeColumns, unit);
  CompareTable places = TableWith("differences", kPlaceColumns, unit);
  CompareTable branches = TableWith("branches", kBranchColumns, unit);
  CompareTable levels = TableWith("levels", kLevelColumns, unit);
  for (const ComparedTrees & one : labels)
  {
    const BranchTotals a = TotalsOf(one.found.a);
    const BranchTotals b = TotalsOf(one.found.b);
    const auto         share = [](double part, double whole) { return whole > 0 ? part / whole : std::nan(""); };
    const double       leakage = b.length - b.foundLength;
    Row                row(one);
    row << a.length << b.length << b.length - a.length << share(a.foundLength, a.length) << a.branches << b.branches
        << share(static_cast<double>(a.found), static_cast<double>(a.branches)) << b.branches - b.found << leakage
        << share(leakage, a.length);
    for (const auto * list : { &one.found.tips, &one.found.bifurcations })
    {
      const auto count = [&](bool inA, bool inB) {
        return ranges::count_if(*list, [&](const PlaceMatch & p) { return p.inA == inA && p.inB == inB; });
      };
      row << count(true, true) << count(true, false) << count(false, true) << MeanOf(*list, &PlaceMatch::distance);
      for (const PlaceMatch & match : *list)
      {
        Row place(one);
        place << (list == &one.found.tips ? "tip" : "bifurcation")
              << (!match.inB   ? "missed"
                  : !match.inA ? "invented"
                               : "found")
              << match.place << match.radius << match.distance << match.angleError;
        place.AddTo(places);
      }
    }
    row << MeanOf(one.found.bifurcations, &PlaceMatch::angleError) << one.found.axis.mean << one.found.axis.percentile95
        << one.found.axis.max << one.found.all.max << one.found.radiusBias << one.found.radiusError;
    row.AddTo(all);
    for (const bool ofA : { true, false })
    {
      const auto & list = ofA ? one.found.a : one.found.b;
      for (std::size_t branch = 0; branch < list.size(); ++branch)
      {
        Row line(one);
        line << (ofA ? "A" : "B") << branch << list[branch].length << list[branch].found << list[branch].share
             << (list[branch].IsFound() ? 1 : 0);
        line.AddTo(branches);
      }
    }
    for (std::size_t level = 0; level < std::max(one.levelsA.size(), one.levelsB.size()); ++level)
    {
      const LevelRecord levelA = level < one.levelsA.size() ? one.levelsA[level] : LevelRecord();
      const LevelRecord levelB = level < one.levelsB.size() ? one.levelsB[level] : LevelRecord();
      Row               line(one);
      line << level << levelA.count << levelB.count << levelA.totalLength << levelB.totalLength;
      line.AddTo(levels);
    }
  }
  return { std::move(all), std::move(places), std::move(branches), std::move(levels) };
}

std::vector<CompareTable>
TablesOf(const std::vector<ComparedCores> & labels, SpatialUnit unit)
{
  CompareTable all = TableWith("labels", kCoreColumns, unit);
  for (const ComparedCores & one : labels)
  {
    Row row(one);
    row << one.found.hausdorff << one.found.percentile95 << one.found.mean << one.found.coverageA
        << one.found.coverageB;
    row.AddTo(all);
  }
  return { std::move(all) };
}

void
WriteCompareCsv(const std::filesystem::path & path, const CompareTable & table, HeadUnits units)
{
  TextFile file(path, tableDigits);
  file << HeadLine(table.columns, units);
  for (const auto & row : table.rows)
  {
    for (std::size_t i = 0; i < row.size(); ++i)
    {
      file << (i > 0 ? "," : "");
      if (const auto * number = std::get_if<std::int64_t>(&row[i]))
      {
        file << *number;
      }
      else if (const auto * real = std::get_if<double>(&row[i]))
      {
        file << *real;
      }
      else if (const auto * text = std::get_if<std::string>(&row[i]))
      {
        file << CsvField(*text);
      }
    }
    file << "\n";
  }
  file.Finish();
}

std::string
CompareColumnsJson(const std::vector<CompareTable> & tables)
{
  std::vector<std::pair<const char *, std::string>> meanings;
  for (const CompareTable & table : tables)
  {
    meanings.emplace_back(table.name.c_str(), ColumnsJson(table.columns, SpatialUnit::Millimetres)); // units stay
  }
  return TablesJson(meanings);
}

nlohmann::ordered_json
TablesAsJson(const std::vector<CompareTable> & tables)
{
  Json json = Json::object();
  for (const CompareTable & table : tables)
  {
    Json rows = Json::array();
    for (const auto & row : table.rows)
    {
      Json object = Json::object();
      for (std::size_t i = 0; i < row.size(); ++i)
      {
        std::visit(
          [&](const auto & value) {
            if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::monostate>)
            {
              object[table.columns[i].name] = nullptr;
            }
            else
            {
              object[table.columns[i].name] = value;
            }
          },
          row[i]);
      }
      rows.push_back(std::move(object));
    }
    json[table.name] = std::move(rows);
  }
  return json;
}

std::string
CompareTablesText(const std::vector<CompareTable> & tables)
{
  // Those that are in the table are shown.
  constexpr std::pair<const char *, const char *> shown[] = {
    { "label", "label" },
    { "name", "name" },
    { "dice", "Dice" },
    { "jaccard", "Jaccard" },
    { "hausdorff", "Hausdorff" },
    { "hausdorff_95", "95 %" },
    { "mean_distance", "mean" },
    { "coverage_a", "A covered" },
    { "coverage_b", "B covered" },
    { "cl_dice", "clDice" },
    { "tree_length_detected", "length found" },
    { "branches_detected", "branches found" },
    { "leakage_ratio", "leakage" },
    { "tips_found", "tips found" },
    { "tips_missed", "missed" },
    { "tips_invented", "invented" },
    { "axis_distance", "axes apart" },
    { "b0_error_26", "b0 error" },
    { "b1_error_26", "b1 error" },
    { "b2_error_26", "b2 error" },
  };
  const CompareTable &                  main = tables.front();
  std::vector<std::vector<std::string>> rows(main.rows.size() + 1);
  for (const auto & [name, head] : shown)
  {
    const auto found = ranges::find(main.columns, name, &TextColumn::name);
    if (found == main.columns.end())
    {
      continue;
    }
    rows[0].push_back(std::string(head) + (found->unit.empty() || found->unit == "1" ? "" : " " + found->unit));
    for (std::size_t row = 0; row < main.rows.size(); ++row)
    {
      rows[row + 1].push_back(CellText(main.rows[row][static_cast<std::size_t>(found - main.columns.begin())]));
    }
  }
  std::string text = FormatTable(rows);
  if (tables.size() < 2)
  {
    return text;
  }
  constexpr std::size_t most = 8; // lines; tables and reports have all
  std::size_t           count = 0;
  const CompareTable &  places = tables[1];
  const auto            column = [&](const char * name) {
    return static_cast<std::size_t>(ranges::find(places.columns, name, &TextColumn::name) - places.columns.begin());
  };
  const std::size_t change = column("change");
  const std::size_t voxels = column("voxels");
  const std::size_t x = column("x");
  for (const auto & row : places.rows)
  {
    if (CellText(row[change]) == "found" || ++count > most)
    {
      continue;
    }
    text += CellText(row[1]) + ": " + CellText(row[change - 1]) + " " + CellText(row[change]);
    if (voxels < row.size())
    {
      text += ", " + CellText(row[voxels]) +
              (CellText(row[voxels]) == "1" ? " voxel, at voxel " : " voxels, at voxel ") + CellText(row[voxels + 1]) +
              "," + CellText(row[voxels + 2]) + "," + CellText(row[voxels + 3]);
    }
    text += " (" + CellText(row[x]) + ", " + CellText(row[x + 1]) + ", " + CellText(row[x + 2]) + ")\n";
  }
  return text + (count > most ? "and " + std::to_string(count - most) + " more differences\n" : "");
}

} // namespace voxelcore
