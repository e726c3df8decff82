#include "ThicknessSteps.h"

#include "voxelcore/Base/LengthUnit.h"
#include "voxelcore/Base/Text.h"
#include "voxelcore/Report/ReportTable.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>
#include <utility>

namespace voxelcore
{

namespace
{

using Json = nlohmann::ordered_json;

double
MeanOf(const std::vector<float> & values)
{
  return std::accumulate(values.begin(), values.end(), 0.0) /
         static_cast<double>(std::max<std::size_t>(values.size(), 1));
}

Json
NumbersJson(const ThicknessNumbers & n)
{
  return { { "voxels", n.voxels },    { "mean_mm", n.mean },          { "sd_mm", n.deviation },
           { "min_mm", n.least },     { "p5_mm", n.quantile5 },       { "p25_mm", n.quantile25 },
           { "median_mm", n.median }, { "p75_mm", n.quantile75 },     { "p95_mm", n.quantile95 },
           { "max_mm", n.greatest },  { "bin_width_mm", n.binWidth }, { "histogram", n.bins } };
}

} // namespace

std::vector<char>
BallsAtSides(const PaintingBalls & balls, const ImageGeometry & geometry, const VoxelBox & box)
{
  std::vector<char> touches(balls.Count(), 0);
  for (std::size_t i = 0; i < touches.size(); ++i)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double reach = balls.radius[i] / geometry.spacing[axis] + 0.5;
      const double place = balls.centres[i][axis] - box.lower[axis];
      if (place < reach || box.size[axis] - place < reach)
      {
        touches[i] = 1;
      }
    }
  }
  return touches;
}

void
SummarizeMap(const VoxelValues &   map,
             const ImageGeometry & geometry,
             std::span<const char> atBorder,
             BorderRule            border,
             ThicknessRecord &     record)
{
  const double bin = *std::min_element(geometry.spacing.begin(), geometry.spacing.end()) / 2;
  record.voxelVolume = geometry.spacing[0] * geometry.spacing[1] * geometry.spacing[2];
  record.borderVoxels = static_cast<std::uint64_t>(std::count(atBorder.begin(), atBorder.end(), char{ 1 }));
  record.withoutBorder = border == BorderRule::Drop;
  if (border != BorderRule::Keep)
  {
    std::vector<float> inner;
    inner.reserve(map.values.size() - record.borderVoxels);
    for (std::size_t i = 0; i < map.values.size(); ++i)
    {
      if (atBorder[i] == 0)
      {
        inner.push_back(map.values[i]);
      }
    }
    record.inner = SummarizeThickness(std::move(inner), bin);
  }
  const bool isInner = record.withoutBorder || (border == BorderRule::Flag && record.borderVoxels == 0);
  record.numbers = isInner ? record.inner : SummarizeThickness(map.values, bin);
}

void
Summarize(const CertifiedThickness & found,
          const ImageGeometry &      geometry,
          std::span<const char>      touches,
          BorderRule                 border,
          ThicknessRecord &          record)
{
  std::vector<char> atBorder(found.owners.values.size(), 0);
  for (std::size_t i = 0; i < atBorder.size(); ++i)
  {
    const std::uint32_t owner = found.owners.values[i];
    atBorder[i] = owner == 0 ? char{ 0 } : touches[owner - 1];
  }
  SummarizeMap(found.map, geometry, atBorder, border, record);
  if (!found.bracket.upper.values.empty())
  {
    record.meanLower = MeanOf(found.bracket.lower.values);
    record.meanUpper = MeanOf(found.bracket.upper.values);
    record.parts = found.parts;
    record.outside = found.outside.voxels;
    record.farthestOutside = found.outside.farthest;
  }
}

std::string
ThicknessJson(const ThicknessResult & result, const ThicknessOptions & options)
{
  Json all = Json::array();
  for (const ThicknessRecord & record : result.thickness)
  {
    Json one;
    if (!record.isSeparation)
    {
      one["label"] = record.label;
    }
    if (record.component > 0)
    {
      one["component"] = record.component;
    }
    one["name"] = record.name;
    one["of"] = record.isSeparation ? "separation" : "thickness";
    if (record.isSeparation)
    {
      one["region"] = options.separation == SeparationRegion::Box    ? "box"
                      : options.separation == SeparationRegion::Hull ? "hull"
                                                                     : "within " + options.within;
    }
    one["all_voxels_count"] = !record.withoutBorder;
    one.update(NumbersJson(record.numbers));
    one["border_voxels"] = record.borderVoxels;
    if (record.inner.voxels > 0)
    {
      one["inner"] = { { "voxels", record.inner.voxels },
                       { "mean_mm", record.inner.mean },
                       { "sd_mm", record.inner.deviation } };
    }
    if (record.meanLower)
    {
      one["bounds"] = { { "lower_mean_mm", *record.meanLower },
                        { "upper_mean_mm", *record.meanUpper },
                        { "voxels_outside", record.outside },
                        { "farthest_outside_mm", record.farthestOutside },
                        { "voxels_cut", record.parts } };
    }
    all.push_back(std::move(one));
  }
  return all.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string
ThicknessText(const ThicknessResult & result)
{
  double longest = 0;
  for (const ThicknessRecord & record : result.thickness)
  {
    longest = std::max(longest, record.numbers.voxels > 0 ? record.numbers.greatest : 0.0);
  }
  const SpatialUnit                     spatial = result.report.input.geometry.unit;
  const LengthUnit                      unit = LengthUnit::For(longest, spatial);
  std::vector<std::vector<std::string>> rows{
    { "label", "name", "voxels", "mean " + unit.Name(), "sd", "median", "5 %", "95 %", "max", "at border" }
  };
  for (const ThicknessRecord & record : result.thickness)
  {
    const ThicknessNumbers & n = record.numbers;
    const std::uint64_t      all = record.withoutBorder ? n.voxels + record.borderVoxels : n.voxels;
    const double percent = all == 0 ? 0 : 100 * static_cast<double>(record.borderVoxels) / static_cast<double>(all);
    const auto   length = [&](double value) { return n.voxels > 0 ? unit.Text(value, 1, 3) : std::string("-"); };
    rows.push_back({ record.isSeparation ? "-" : std::to_string(record.label),
                     record.name,
                     std::to_string(n.voxels),
                     length(n.mean),
                     length(n.deviation),
                     length(n.median),
                     length(n.quantile5),
                     length(n.quantile95),
                     length(n.greatest),
                     FixedText(percent, 1) + " %" });
  }
  std::string text = FormatTable(rows);
  for (const ThicknessRecord & record : result.thickness)
  {
    if (record.outside > 0)
    {
      text += record.name + ": " + std::to_string(record.outside) + " voxels lie outside the bounds, by up to " +
              unit.Text(record.farthestOutside, 1, 3) + " " + unit.Name() +
              ": the surface is none that the labels allow; compare with --refine labels\n";
    }
  }
  return text;
}

} // namespace voxelcore
