#include "ThicknessSteps.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
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

std::filesystem::path
Beside(const std::filesystem::path & output, const std::string & what)
{
  const std::string name = output.filename().string();
  const std::size_t end = name.ends_with(".nii.gz") ? name.size() - 7 : name.rfind('.');
  return output.parent_path() / (name.substr(0, end) + what + name.substr(end));
}

void
Summarize(const CertifiedThickness & found,
          const ImageGeometry &      geometry,
          const VoxelBox &           region,
          BorderRule                 border,
          ThicknessRecord &          record)
{
  std::vector<char> touches(found.balls.Count(), 0);
  for (std::size_t i = 0; i < touches.size(); ++i)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double reach = found.balls.radius[i] / geometry.spacing[axis] + 0.5;
      const double place = found.balls.centres[i][axis] - region.lower[axis];
      if (place < reach || region.size[axis] - place < reach)
      {
        touches[i] = 1;
      }
    }
  }
  std::vector<float> inner;
  for (std::size_t i = 0; i < found.map.values.size(); ++i)
  {
    const std::uint32_t owner = found.owners.values[i];
    if (owner == 0 || touches[owner - 1] == 0)
    {
      inner.push_back(found.map.values[i]);
    }
  }
  const double bin = *std::min_element(geometry.spacing.begin(), geometry.spacing.end()) / 2;
  record.voxelVolume = geometry.spacing[0] * geometry.spacing[1] * geometry.spacing[2];
  record.borderVoxels = found.map.values.size() - inner.size();
  record.inner = SummarizeThickness(std::move(inner), bin);
  record.withoutBorder = border == BorderRule::Drop;
  record.numbers = record.withoutBorder ? record.inner : SummarizeThickness(found.map.values, bin);
  if (border == BorderRule::Keep)
  {
    record.inner = ThicknessNumbers();
  }
  if (!found.bracket.upper.values.empty())
  {
    record.meanLower = MeanOf(found.bracket.lower.values);
    record.meanUpper = MeanOf(found.bracket.upper.values);
  }
}

VoxelBox
BoxAround(const std::vector<VoxelShape> & shapes)
{
  std::array<std::int32_t, 3> lower{};
  std::array<std::int32_t, 3> upper{};
  lower.fill(std::numeric_limits<std::int32_t>::max());
  upper.fill(0);
  for (const VoxelShape & shape : shapes)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      lower[axis] = std::min(lower[axis], shape.Box().lower[axis]);
      upper[axis] = std::max(upper[axis], shape.Box().lower[axis] + shape.Box().size[axis]);
    }
  }
  return { lower, { upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2] } };
}

VoxelShape
BackgroundIn(const VoxelBox & box, const std::vector<VoxelShape> & shapes)
{
  VoxelShape background(box);
  for (std::int32_t z = 0; z < box.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < box.size[1]; ++y)
    {
      const auto row = background.Row(y, z);
      for (std::int32_t x = 0; x < box.size[0]; ++x)
      {
        row[static_cast<std::size_t>(x) >> 6U] |= std::uint64_t{ 1 } << (static_cast<unsigned>(x) & 63U);
      }
      for (const VoxelShape & shape : shapes)
      {
        const auto &       own = shape.Box();
        const std::int32_t ownY = y + box.lower[1] - own.lower[1];
        const std::int32_t ownZ = z + box.lower[2] - own.lower[2];
        if (ownY < 0 || ownY >= own.size[1] || ownZ < 0 || ownZ >= own.size[2])
        {
          continue;
        }
        const auto bits = shape.Row(ownY, ownZ);
        for (std::size_t word = 0; word < bits.size(); ++word)
        {
          for (std::uint64_t rest = bits[word]; rest != 0; rest &= rest - 1)
          {
            const auto x = static_cast<std::uint32_t>(64 * static_cast<std::int32_t>(word) + std::countr_zero(rest) +
                                                      own.lower[0] - box.lower[0]);
            row[x >> 6U] &= ~(std::uint64_t{ 1 } << (x & 63U));
          }
        }
      }
    }
  }
  return background;
}

std::string
WithThickness(std::string report, const ThicknessResult & result)
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
      one["bounds"] = { { "lower_mean_mm", *record.meanLower }, { "upper_mean_mm", *record.meanUpper } };
    }
    all.push_back(std::move(one));
  }
  const std::string text =
    KeysInUnit(all, result.report.input.geometry.unit).dump(2, ' ', false, Json::error_handler_t::replace);
  report.replace(report.rfind("\n}"), std::string::npos, ",\n  \"thickness\": " + text + "\n}\n");
  return report;
}

} // namespace voxelcore
