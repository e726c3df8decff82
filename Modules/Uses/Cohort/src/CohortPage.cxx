#include "CohortPage.h"

#include "CohortPageText.h"
#include "voxelcore/Base/LengthUnit.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Report/CoreReport.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <utility>

namespace voxelcore
{

namespace
{

using Json = nlohmann::ordered_json;

/** The numbers of a label on the page: what the column is called, where it is in labels.csv, and the power of mm it is
 *  in there; 0: a count. */
struct PageColumn
{
  const char * title;
  const char * key;
  int          power = 0;
};

constexpr PageColumn kColumns[] = {
  { "volume", "volume_mm3", 3 },
  { "area", "pruned_0_area_mm2", 2 },
  { "max radius", "core_max_radius_mm", 1 },
  { "pieces", "shape_betti_0" },
  { "loops", "shape_betti_1" },
  { "cavities", "shape_betti_2" },
  { "branches", "skeleton_branches" },
  { "tips", "skeleton_tips" },
  { "junctions", "skeleton_junctions" },
  { "length", "skeleton_total_length_mm", 1 },
  { "mean radius", "skeleton_mean_radius_mm", 1 },
  { "roots", "plant_roots" },
  { "stem length", "plant_stem_length_mm", 1 },
  { "stem diameter", "plant_stem_diameter_mm", 1 },
  { "root length", "plant_total_length_mm", 1 },
  { "depth", "plant_depth_mm", 1 },
  { "width", "plant_width_mm", 1 },
  { "hull", "plant_hull_volume_mm3", 3 },
  { "whorls", "plant_whorls" },
  { "contacts", "plant_contacts" },
  { "mean thickness", "thickness_mean_mm", 1 },
  { "sd", "thickness_sd_mm", 1 },
  { "5 %", "thickness_p5_mm", 1 },
  { "median", "thickness_median_mm", 1 },
  { "95 %", "thickness_p95_mm", 1 },
  { "max", "thickness_max_mm", 1 },
  { "Dice", "compare_dice" },
  { "clDice", "compare_cl_dice" },
  { "Hausdorff 95 %", "compare_hausdorff_95_mm", 1 },
  { "mean distance", "compare_mean_distance_mm", 1 },
  { "pieces' error", "compare_b0_error_26" },
  { "loops' error", "compare_b1_error_26" },
  { "cavities' error", "compare_b2_error_26" },
  { "length found", "compare_tree_length_detected" },
  { "branches found", "compare_branches_detected" },
  { "leakage", "compare_leakage_ratio" },
  { "tips missed", "compare_tips_missed" },
  { "tips invented", "compare_tips_invented" },
  { "axes apart", "compare_axis_distance_mm", 1 },
};

/** JSON that no parser of HTML takes for an end tag or a comment. */
std::string
InScript(const Json & json)
{
  std::string text;
  for (const char c : json.dump(-1, ' ', false, Json::error_handler_t::replace))
  {
    text += c == '<'   ? std::string("\\u003c")
            : c == '>' ? std::string("\\u003e")
            : c == '&' ? std::string("\\u0026")
                       : std::string(1, c);
  }
  return text;
}

/** A column of the page, its lengths in one unit. */
struct ShownColumn
{
  std::string title;
  std::string key;
  int         power;
  LengthUnit  unit;
};

bool
HasColumn(const std::vector<PageCase> & cases, const std::string & key)
{
  return std::any_of(cases.begin(), cases.end(), [&](const PageCase & one) {
    return std::any_of(one.labels.begin(), one.labels.end(), [&](const Row & row) { return row.contains(key); });
  });
}

/** Of one command each, what says how large a body is, and in which power of mm. */
constexpr std::pair<const char *, int> kSizes[] = { { "volume_mm3", 3 },
                                                    { "compare_volume_a_mm3", 3 },
                                                    { "compare_length_a_mm", 1 } };

bool
HasSizes(const std::vector<PageCase> & cases, SpatialUnit lengths)
{
  return ranges::any_of(kSizes, [&](const auto & size) { return HasColumn(cases, InUnit(size.first, lengths)); });
}

/** One for the whole page, by its largest body, as `info` does for a scan. */
LengthUnit
UnitOf(const std::vector<PageCase> & cases, SpatialUnit lengths)
{
  double largest = 0;
  for (const PageCase & one : cases)
  {
    for (const Row & row : one.labels)
    {
      for (const auto & [key, power] : kSizes)
      {
        if (const auto found = row.find(InUnit(key, lengths)); found != row.end() && found->is_number())
        {
          const double size = found->get<double>();
          largest = std::max(largest, power == 3 ? std::cbrt(size) : size);
        }
      }
    }
  }
  return LengthUnit::For(largest, lengths);
}

/** Cases without a voxel size have columns of their own, in voxels. */
std::vector<ShownColumn>
ColumnsOf(const std::vector<PageCase> & cases)
{
  const bool               inVoxels = HasSizes(cases, SpatialUnit::Voxels);
  std::vector<SpatialUnit> units;
  if (!inVoxels || HasSizes(cases, SpatialUnit::Millimetres))
  {
    units.push_back(SpatialUnit::Millimetres);
  }
  if (inVoxels)
  {
    units.push_back(SpatialUnit::Voxels);
  }
  std::vector<ShownColumn> columns;
  for (const PageColumn & column : kColumns)
  {
    if (!HasColumn(cases, column.key) && !HasColumn(cases, InUnit(column.key, SpatialUnit::Voxels)))
    {
      continue; // of another command
    }
    for (const SpatialUnit lengths : column.power > 0 ? units : std::vector{ units.front() })
    {
      const LengthUnit unit = UnitOf(cases, lengths);
      columns.push_back({ column.title + (column.power > 0 ? " " + unit.Symbol(column.power) : std::string()),
                          InUnit(column.key, lengths),
                          column.power,
                          unit });
    }
  }
  return columns;
}

/** Counts of a label's thickness by bins from 0 on, and the bins' width; null where a row has none. */
Json
HistogramJson(const Row & row, const std::vector<ShownColumn> & columns)
{
  const auto counts = row.find("thickness_histogram");
  if (counts == row.end())
  {
    return nullptr;
  }
  for (const ShownColumn & column : columns)
  {
    for (const SpatialUnit lengths : { SpatialUnit::Millimetres, SpatialUnit::Voxels })
    {
      const auto width = row.find(InUnit("thickness_bin_width_mm", lengths));
      if (column.key == InUnit("thickness_mean_mm", lengths) && width != row.end() && width->is_number())
      {
        Json               bins = Json::array();
        std::istringstream text(counts->get<std::string>());
        for (std::uint64_t count = 0; text >> count;)
        {
          bins.push_back(count);
        }
        return { { "unit", column.unit.Symbol(1) },
                 { "width", column.unit.Of(width->get<double>(), 1) },
                 { "counts", bins } };
      }
    }
  }
  return nullptr;
}

Json
LabelJson(const Row & row, const std::vector<ShownColumn> & columns)
{
  Json              values = Json::array();
  Json              outliers = Json::object();
  const std::string marks = " " + row.at("outliers").get<std::string>() + " ";
  for (std::size_t i = 0; i < columns.size(); ++i)
  {
    const auto & [title, key, power, unit] = columns[i];
    const auto found = row.find(key);
    const bool known = found != row.end() && found->is_number();
    values.push_back(!known ? Json(nullptr) : power == 0 ? *found : Json(unit.Of(found->get<double>(), power)));
    if (marks.find(" " + key + "+ ") != std::string::npos)
    {
      outliers[std::to_string(i)] = 1;
    }
    if (marks.find(" " + key + "- ") != std::string::npos)
    {
      outliers[std::to_string(i)] = -1;
    }
  }
  const std::string part = row.contains("component") ? " #" + row.at("component").dump() : "";
  return { { "label", row.at("label") }, { "name", row.at("name").get<std::string>() + part },
           { "values", values },         { "certificate", row.value("certificate_passed", Json(nullptr)) },
           { "outliers", outliers },     { "histogram", HistogramJson(row, columns) } };
}

Json
CaseJson(const PageCase & one, const std::vector<ShownColumn> & columns)
{
  Json json = { { "id", one.record.id },
                { "folder", one.folder },
                { "done", one.record.done },
                { "reason", one.record.reason },
                { "warnings", one.record.warnings },
                { "thumbnail", "" },
                { "view", "" },
                { "files", Json::array() },
                { "labels", Json::array() } };
  for (const RecordedFile & output : one.record.outputs)
  {
    if (output.name.ends_with("_thumbnail.png"))
    {
      json["thumbnail"] = output.name;
    }
    else if (output.name.ends_with("_view.html") || output.name == one.folder + "_page.html")
    {
      json["view"] = output.name;
    }
    else
    {
      const bool ours = output.name.starts_with(one.folder + "_");
      json["files"].push_back({ ours ? output.name.substr(one.folder.size() + 1) : output.name, output.name });
    }
  }
  for (const Row & row : one.labels)
  {
    json["labels"].push_back(LabelJson(row, columns));
  }
  return json;
}

} // namespace

std::string
CohortPage(const std::vector<PageCase> & cases)
{
  const std::vector<ShownColumn> columns = ColumnsOf(cases);
  Json                           data;
  data["version"] = VoxelCoreVersion();
  data["columns"] = Json::array();
  for (const ShownColumn & column : columns)
  {
    data["columns"].push_back(column.title);
  }
  data["cases"] = Json::array();
  for (const PageCase & one : cases)
  {
    data["cases"].push_back(CaseJson(one, columns));
  }
  return std::string(kCohortPageHead) + InScript(data) + std::string(kCohortPageTail);
}

} // namespace voxelcore
