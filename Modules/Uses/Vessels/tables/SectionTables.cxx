#include "voxelcore/Vessels/SectionTables.h"

#include "voxelcore/Models/AppendedVtp.h"
#include "voxelcore/Models/TableColumns.h"

#include <algorithm>
#include <array>
#include <utility>

namespace voxelcore
{

namespace
{

constexpr auto kSectionColumns = std::to_array<Column>({
  kLabelColumn,
  kNameColumn,
  kPartColumn,
  kBranchIdColumn,
  { "arc_length", "mm", "along the branch from its first point" },
  { "place_x", "mm", "on the branch, LPS" },
  { "place_y", "mm", "" },
  { "place_z", "mm", "" },
  { "axis_x", "1", "direction of the branch, at right angles to the section, LPS" },
  { "axis_y", "1", "" },
  { "axis_z", "1", "" },
  { "area", "mm^2", "of the body's piece around the branch in this plane" },
  { "equivalent_diameter", "mm", "of the circle with this area" },
  { "least_diameter", "mm", "least distance of two parallel lines around the section" },
  { "least_x", "1", "direction across these lines, LPS" },
  { "least_y", "1", "" },
  { "least_z", "1", "" },
  { "greatest_diameter", "mm", "greatest distance of two points of the section" },
  { "greatest_x", "1", "direction from one to the other, LPS" },
  { "greatest_y", "1", "" },
  { "greatest_z", "1", "" },
  { "perimeter", "mm", "length of its contours, those of holes included" },
  { "circularity", "1", "4 pi area / perimeter^2: 1 for a circle" },
  { "centre_x", "mm", "centre of gravity, LPS" },
  { "centre_y", "mm", "" },
  { "centre_z", "mm", "" },
  { "runs_into", "", "another branch that part of the contour belongs to; empty: none" },
  { "cut_by_border", "", "1: it reaches the border of the scan" },
});

constexpr auto kLesionColumns = std::to_array<Column>({
  kLabelColumn,
  kNameColumn,
  kPartColumn,
  { "branch_id", "", "number of the branch; of a dome, the one that leads into it" },
  { "kind", "", "stenosis, bulge (ectasia or fusiform aneurysm), or dome (saccular aneurysm)" },
  { "arc_length", "mm", "along the branch, of its extreme diameter; of a dome, of its neck" },
  { "place_x", "mm", "on the branch there, LPS" },
  { "place_y", "mm", "" },
  { "place_z", "mm", "" },
  { "length", "mm", "of the part narrower or wider by a tenth; of a dome, from its neck" },
  { "diameter", "mm", "least of a stenosis, greatest of others, as equivalent_diameter" },
  { "reference_diameter", "mm", "of the healthy vessel there; of a dome, of the vessel at its foot" },
  { "degree_by_diameter", "%", "less or more than the reference; of a stenosis as in NASCET" },
  { "degree_by_area", "%", "the same of areas" },
  { "neck_width", "mm", "diameter of a dome's least section" },
  { "dome_height", "mm", "from the plane of the neck to the farthest point" },
  { "dome_volume", "mm^3", "of the voxels beyond that plane" },
  { "aspect_ratio", "1", "dome_height / neck_width" },
});

using Add = void (*)(std::vector<double> &, const BranchSection &);

/** What a contour carries on. */
constexpr auto kCellNumbers = std::to_array<std::pair<const char *, Add>>({
  { "ArcLength", [](std::vector<double> & to, const BranchSection & s) { to.push_back(s.arc); } },
  { "Area", [](std::vector<double> & to, const BranchSection & s) { to.push_back(s.area); } },
  { "EquivalentDiameter",
    [](std::vector<double> & to, const BranchSection & s) { to.push_back(s.EquivalentDiameter()); } },
  { "LeastDiameter", [](std::vector<double> & to, const BranchSection & s) { to.push_back(s.leastDiameter); } },
  { "GreatestDiameter", [](std::vector<double> & to, const BranchSection & s) { to.push_back(s.greatestDiameter); } },
  { "Perimeter", [](std::vector<double> & to, const BranchSection & s) { to.push_back(s.perimeter); } },
  { "Circularity", [](std::vector<double> & to, const BranchSection & s) { to.push_back(s.Circularity()); } },
});

} // namespace

SectionsOfPart
NameSections(const SkeletonPart & part, std::vector<BranchSection> sections, std::vector<VesselLesion> lesions)
{
  SectionsOfPart named;
  named.sections = std::move(sections);
  named.lesions = std::move(lesions);
  named.component = part.component;
  for (std::size_t branch = 0; branch < part.graph.BranchCount(); ++branch)
  {
    named.labels.push_back(part.network ? part.graph.BranchLabel(branch) : part.label);
    named.names.push_back(part.network ? part.network->NameOf(named.labels.back()) : part.name);
  }
  return named;
}

void
WriteSectionCsv(const std::filesystem::path & path, const std::vector<SectionsOfPart> & parts, HeadUnits units)
{
  TextFile file(path, tableDigits);
  file << HeadLine(kSectionColumns, units);
  const auto vector = [&](const Vector3 & of) { file << "," << of[0] << "," << of[1] << "," << of[2]; };
  // Where there is no section, its directions are none either.
  const auto direction = [&](const Vector3 & of) {
    if (of == Vector3{})
    {
      file << ",,,";
    }
    else
    {
      vector(of);
    }
  };
  for (const SectionsOfPart & part : parts)
  {
    for (const BranchSection & s : part.sections)
    {
      file << part.labels[s.branch] << "," << CsvField(part.names[s.branch]) << "," << part.component << "," << s.branch
           << "," << s.arc;
      vector(s.place);
      direction(s.axis);
      file << "," << s.area << "," << s.EquivalentDiameter() << "," << s.leastDiameter;
      direction(s.leastWay);
      file << "," << s.greatestDiameter;
      direction(s.greatestWay);
      file << "," << s.perimeter << "," << s.Circularity();
      vector(s.centre);
      file << ",";
      if (s.runsInto != kNoBranch)
      {
        file << s.runsInto;
      }
      file << "," << (s.isCut ? 1 : 0) << "\n";
    }
  }
  file.Finish();
}

void
WriteSectionVtp(const std::filesystem::path & path, const std::vector<SectionsOfPart> & parts, SpatialUnit unit)
{
  VtpContent                                               content;
  std::array<std::vector<std::int64_t>, 5>                 whole;
  std::array<std::vector<double>, std::size(kCellNumbers)> numbers;
  VtpCells &                                               lines = content.cells[1];
  for (const SectionsOfPart & part : parts)
  {
    for (const BranchSection & s : part.sections)
    {
      for (const auto & contour : s.contours)
      {
        const auto first = static_cast<std::int64_t>(content.positions.size() / 3);
        for (const Vector3 & point : contour)
        {
          lines.points.push_back(static_cast<std::int64_t>(content.positions.size() / 3));
          content.positions.insert(content.positions.end(), point.begin(), point.end());
        }
        lines.points.push_back(first);
        lines.offsets.push_back(static_cast<std::int64_t>(lines.points.size()));
        const std::array<std::int64_t, 5> values{ s.branch,
                                                  part.labels[s.branch],
                                                  part.component,
                                                  s.runsInto == kNoBranch ? -1 : static_cast<std::int64_t>(s.runsInto),
                                                  s.isCut ? 1 : 0 };
        for (std::size_t k = 0; k < values.size(); ++k)
        {
          whole[k].push_back(values[k]);
        }
        for (std::size_t k = 0; k < numbers.size(); ++k)
        {
          kCellNumbers[k].second(numbers[k], s);
        }
      }
    }
  }
  content.texts = { { "SPACE", "LPS" }, { "Units", UnitName(unit) } };
  constexpr std::array<const char *, 5> names{ "BranchId", "Label", "Component", "RunsInto", "CutByBorder" };
  for (std::size_t k = 0; k < names.size(); ++k)
  {
    content.cellArrays.emplace_back(names[k], std::move(whole[k]));
  }
  for (std::size_t k = 0; k < numbers.size(); ++k)
  {
    content.cellArrays.emplace_back(kCellNumbers[k].first, std::move(numbers[k]));
  }
  WriteVtp(path, std::move(content));
}

const char *
LesionText(LesionKind kind)
{
  return kind == LesionKind::Stenosis ? "stenosis" : kind == LesionKind::Bulge ? "bulge" : "dome";
}

void
WriteLesionCsv(const std::filesystem::path & path, const std::vector<SectionsOfPart> & parts, HeadUnits units)
{
  TextFile file(path, tableDigits);
  file << HeadLine(kLesionColumns, units);
  for (const SectionsOfPart & part : parts)
  {
    for (const VesselLesion & one : part.lesions)
    {
      file << part.labels[one.branch] << "," << CsvField(part.names[one.branch]) << "," << part.component << ","
           << one.branch << "," << LesionText(one.kind) << "," << one.arc;
      for (const double number : { one.place[0],
                                   one.place[1],
                                   one.place[2],
                                   one.end - one.begin,
                                   one.diameter,
                                   one.reference,
                                   100 * one.DegreeByDiameter(),
                                   100 * one.DegreeByArea(),
                                   one.neckWidth,
                                   one.height,
                                   one.volume,
                                   one.AspectRatio() })
      {
        file << "," << number;
      }
      file << "\n";
    }
  }
  file.Finish();
}

std::string
SectionColumnsJson(SpatialUnit unit)
{
  return TablesJson(
    { { "sections", ColumnsJson(kSectionColumns, unit) }, { "lesions", ColumnsJson(kLesionColumns, unit) } });
}

} // namespace voxelcore
