#include "voxelcore/Models/AppendedVtp.h"
#include "voxelcore/Models/TableColumns.h"

#include "voxelcore/Models/SkeletonModel.h"
#include "voxelcore/Thickness/ThicknessFiles.h"

#include <array>
#include <utility>

namespace voxelcore
{

namespace
{

constexpr auto kNumberColumns = std::to_array<Column>({
  kLabelColumn,
  kNameColumn,
  kPartColumn,
  { "of", "", "thickness of the label, or separation of the background" },
  { "voxels", "", "voxels that count" },
  { "volume", "mm^3", "of these voxels" },
  { "mean", "mm", "mean over these voxels: Tb.Th, Ct.Th, Tb.Sp" },
  { "sd", "mm", "standard deviation: Tb.Th.SD, Tb.Sp.SD" },
  { "min", "mm", "least" },
  { "p5", "mm", "5 % of the voxels are not thicker" },
  { "p25", "mm", "25 % of the voxels are not thicker" },
  { "median", "mm", "50 % of the voxels are not thicker" },
  { "p75", "mm", "75 % of the voxels are not thicker" },
  { "p95", "mm", "95 % of the voxels are not thicker" },
  { "max", "mm", "greatest" },
  { "border_voxels", "", "voxels whose ball touches the border of the scan or crop" },
  { "inner_mean", "mm", "mean without these" },
  { "inner_sd", "mm", "standard deviation without these" },
  { "lower_mean", "mm", "mean of the lower bound of --bounds" },
  { "upper_mean", "mm", "mean of the upper bound of --bounds" },
});

constexpr auto kHistogramColumns = std::to_array<Column>({
  kLabelColumn,
  kNameColumn,
  kPartColumn,
  { "of", "", "thickness or separation" },
  { "from", "mm", "lower end of the bin" },
  { "to", "mm", "upper end of the bin" },
  { "voxels", "", "voxels in it" },
  { "fraction", "1", "of the voxels that count" },
});

void
WriteNames(TextFile & file, const ThicknessRecord & record)
{
  file << record.label << "," << CsvField(record.name) << "," << record.component << ","
       << (record.isSeparation ? "separation" : "thickness");
}

} // namespace

void
WriteThicknessCsv(const std::filesystem::path & path, const std::vector<ThicknessRecord> & records, HeadUnits units)
{
  TextFile file(path, tableDigits);
  file << HeadLine(kNumberColumns, units);
  for (const ThicknessRecord & record : records)
  {
    const ThicknessNumbers & n = record.numbers;
    WriteNames(file, record);
    file << "," << n.voxels << "," << static_cast<double>(n.voxels) * record.voxelVolume << "," << n.mean << ","
         << n.deviation << "," << n.least << "," << n.quantile5 << "," << n.quantile25 << "," << n.median << ","
         << n.quantile75 << "," << n.quantile95 << "," << n.greatest << "," << record.borderVoxels << ",";
    if (record.inner.voxels > 0)
    {
      file << record.inner.mean << "," << record.inner.deviation;
    }
    else
    {
      file << ",";
    }
    for (const auto & bound : { record.meanLower, record.meanUpper })
    {
      file << ",";
      if (bound)
      {
        file << *bound;
      }
    }
    file << "\n";
  }
  file.Finish();
}

void
WriteThicknessHistogramCsv(const std::filesystem::path &        path,
                           const std::vector<ThicknessRecord> & records,
                           HeadUnits                            units)
{
  TextFile file(path, tableDigits);
  file << HeadLine(kHistogramColumns, units);
  for (const ThicknessRecord & record : records)
  {
    const ThicknessNumbers & n = record.numbers;
    for (std::size_t bin = 0; bin < n.bins.size(); ++bin)
    {
      WriteNames(file, record);
      file << "," << static_cast<double>(bin) * n.binWidth << "," << static_cast<double>(bin + 1) * n.binWidth << ","
           << n.bins[bin] << "," << static_cast<double>(n.bins[bin]) / static_cast<double>(n.voxels) << "\n";
    }
  }
  file.Finish();
}

void
WriteThicknessVtp(const std::filesystem::path &         path,
                  const std::vector<ThicknessSurface> & surfaces,
                  SpatialUnit                           unit,
                  const std::string &                   provenance)
{
  VtpContent                content;
  std::vector<double>       thickness;
  std::vector<std::int64_t> labels;
  std::vector<std::int64_t> components;
  std::int64_t              first = 0;
  for (const ThicknessSurface & one : surfaces)
  {
    for (const auto & point : one.surface.points)
    {
      content.positions.insert(content.positions.end(), point.begin(), point.end());
    }
    thickness.insert(thickness.end(), one.thickness.begin(), one.thickness.end());
    for (const auto & triangle : one.surface.triangles)
    {
      for (const std::uint32_t corner : triangle)
      {
        content.cells[2].points.push_back(first + corner);
      }
      content.cells[2].offsets.push_back(static_cast<std::int64_t>(content.cells[2].points.size()));
      labels.push_back(one.label);
      components.push_back(one.component);
    }
    first += static_cast<std::int64_t>(one.surface.points.size());
  }
  content.texts = { { "SPACE", "LPS" }, { "Units", UnitName(unit) }, { "Provenance", provenance } };
  content.pointArrays = { { "Thickness", std::move(thickness) } };
  content.cellArrays = { { "Label", std::move(labels) }, { "Component", std::move(components) } };
  WriteVtp(path, std::move(content));
}

std::string
ThicknessColumnsJson(SpatialUnit unit)
{
  return TablesJson(
    { { "thickness", ColumnsJson(kNumberColumns, unit) }, { "histogram", ColumnsJson(kHistogramColumns, unit) } });
}

} // namespace voxelcore
