#include "CaseTable.h"
#include "voxelcore/Base/SpatialUnit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

namespace voxelcore
{

namespace
{

constexpr std::size_t kFewest = 5;
constexpr double      kFar = 3.5;
constexpr double      kMedianToDeviation = 1.4826;
constexpr double      kMeanToDeviation = 1.2533;

constexpr auto kCompared = std::to_array<const char *>({ "volume_mm3",
                                                         "pruned_0_area_mm2",
                                                         "core_max_radius_mm",
                                                         "skeleton_branches",
                                                         "skeleton_tips",
                                                         "skeleton_junctions",
                                                         "skeleton_total_length_mm",
                                                         "skeleton_mean_radius_mm",
                                                         "plant_roots",
                                                         "plant_stem_length_mm",
                                                         "plant_stem_diameter_mm",
                                                         "plant_total_length_mm",
                                                         "plant_depth_mm",
                                                         "plant_width_mm",
                                                         "plant_hull_volume_mm3",
                                                         "plant_whorls",
                                                         "plant_contacts",
                                                         "thickness_mean_mm",
                                                         "thickness_sd_mm",
                                                         "thickness_median_mm",
                                                         "thickness_max_mm",
                                                         "compare_dice",
                                                         "compare_cl_dice",
                                                         "compare_hausdorff_95_mm",
                                                         "compare_tree_length_detected" });

std::optional<double>
NumberAt(const Row & row, const std::string & column)
{
  const auto found = row.find(column);
  return found != row.end() && found->is_number() ? std::optional<double>(found->get<double>()) : std::nullopt;
}

/** Compares rows of one label in one column. */
void
Mark(std::vector<Row> & rows, const std::vector<std::size_t> & which, const std::string & column)
{
  std::vector<double>      values;
  std::vector<std::size_t> places;
  for (const std::size_t i : which)
  {
    if (const auto value = NumberAt(rows[i], column))
    {
      values.push_back(*value);
      places.push_back(i);
    }
  }
  if (values.size() < kFewest)
  {
    return;
  }
  const double        median = Median(values);
  std::vector<double> distances;
  double              sum = 0;
  for (const double value : values)
  {
    distances.push_back(std::abs(value - median));
    sum += distances.back();
  }
  const double middle = Median(distances);
  const double deviation =
    middle > 0 ? kMedianToDeviation * middle : kMeanToDeviation * sum / static_cast<double>(values.size());
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    if (distances[i] > kFar * deviation)
    {
      std::string text = rows[places[i]].at("outliers").get<std::string>();
      text += (text.empty() ? "" : " ") + column + (values[i] > median ? "+" : "-");
      rows[places[i]]["outliers"] = text;
    }
  }
}

} // namespace

double
Median(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

void
FindOutliers(std::vector<Row> & rows)
{
  std::map<std::string, std::vector<std::size_t>> byLabel;
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    byLabel[rows[i].at("label").dump() + "\n" + rows[i].at("name").dump()].push_back(i);
    rows[i]["outliers"] = "";
  }
  for (const auto & [label, which] : byLabel)
  {
    for (const char * column : kCompared)
    {
      // Scans without a voxel size have columns of their own, and are compared with each other.
      const std::string inVoxels = InUnit(column, SpatialUnit::Voxels);
      Mark(rows, which, column);
      if (inVoxels != column)
      {
        Mark(rows, which, inVoxels);
      }
    }
  }
}

} // namespace voxelcore
