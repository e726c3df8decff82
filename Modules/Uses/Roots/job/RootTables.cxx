#include "RootAnnotations.h"
#include "voxelcore/Models/TableColumns.h"

#include "voxelcore/Models/SkeletonModel.h"
#include "voxelcore/Roots/RootFiles.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace voxelcore
{

namespace
{

/** A column that knows its values. */
template <typename Row>
struct ValueColumn
{
  const char * name;
  const char * unit;
  const char * meaning;
  double (*value)(const Row &);
};

/** A root with its place in the plant. */
struct RootRow
{
  std::size_t        number;
  const RootAxis &   axis;
  const RootRecord & record;
};

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

constexpr auto kRootColumns = std::to_array<ValueColumn<RootRow>>({
  { "root",
    "",
    "number of the root; stems first, then level by level",
    [](const RootRow & r) { return static_cast<double>(r.number); } },
  { "parent",
    "",
    "root it springs from; empty for a stem",
    [](const RootRow & r) { return r.axis.parent == kNoRoot ? kNone : static_cast<double>(r.axis.parent); } },
  { "stem", "", "stem of its plant", [](const RootRow & r) { return static_cast<double>(r.axis.stem); } },
  { "level",
    "",
    "0 a stem, 1 its laterals, 2 theirs",
    [](const RootRow & r) { return static_cast<double>(r.axis.level); } },
  { "length",
    "mm",
    "along the root, from the surface of its parent to its tip",
    [](const RootRow & r) { return r.record.length; } },
  { "chord", "mm", "distance from its base to its tip", [](const RootRow & r) { return r.record.chord; } },
  { "tortuosity", "1", "length / chord", [](const RootRow & r) { return r.record.tortuosity; } },
  { "mean_diameter",
    "mm",
    "mean along the root, of a round tube with its cross-section area",
    [](const RootRow & r) { return r.record.meanDiameter; } },
  { "min_diameter", "mm", "least along it", [](const RootRow & r) { return r.record.minDiameter; } },
  { "max_diameter", "mm", "greatest along it", [](const RootRow & r) { return r.record.maxDiameter; } },
  { "volume", "mm^3", "of the round cones between its points", [](const RootRow & r) { return r.record.volume; } },
  { "surface", "mm^2", "lateral area of these cones", [](const RootRow & r) { return r.record.surface; } },
  { "emergence_angle",
    "deg",
    "between its parent's direction and its own, one to four diameters from its base",
    [](const RootRow & r) { return r.record.emergenceAngle; } },
  { "midpoint_angle",
    "deg",
    "between its parent's direction and the way from its base to its middle",
    [](const RootRow & r) { return r.record.midpointAngle; } },
  { "tip_angle",
    "deg",
    "between its parent's direction and the way from its base to its tip",
    [](const RootRow & r) { return r.record.tipAngle; } },
  { "emergence_from_down",
    "deg",
    "between down and its direction at the base",
    [](const RootRow & r) { return r.record.emergenceFromDown; } },
  { "midpoint_from_down",
    "deg",
    "between down and the way from its base to its middle",
    [](const RootRow & r) { return r.record.midpointFromDown; } },
  { "tip_from_down",
    "deg",
    "between down and the way from its base to its tip",
    [](const RootRow & r) { return r.record.tipFromDown; } },
  { "parent_position",
    "mm",
    "along its parent, from the parent's base to where it springs",
    [](const RootRow & r) { return r.record.alongParent; } },
  { "base_depth",
    "mm",
    "of its base below the base of the first stem",
    [](const RootRow & r) { return r.record.baseDepth; } },
  { "tip_depth",
    "mm",
    "of its tip below the base of the first stem",
    [](const RootRow & r) { return r.record.tipDepth; } },
  { "children",
    "",
    "roots that spring from it",
    [](const RootRow & r) { return static_cast<double>(r.record.children); } },
  { "ends_at_contact",
    "",
    "1: it ends where it touches another root",
    [](const RootRow & r) { return r.axis.endsAtContact ? 1.0 : 0.0; } },
  { "undecided",
    "",
    "1: it passes a contact that could be paired otherwise",
    [](const RootRow & r) { return r.axis.undecided ? 1.0 : 0.0; } },
  { "loose", "", "1: its piece has no stem", [](const RootRow & r) { return r.axis.loose ? 1.0 : 0.0; } },
  { "base_x", "mm", "base, LPS", [](const RootRow & r) { return r.record.base[0]; } },
  { "base_y", "mm", "base, LPS", [](const RootRow & r) { return r.record.base[1]; } },
  { "base_z", "mm", "base, LPS", [](const RootRow & r) { return r.record.base[2]; } },
  { "tip_x", "mm", "tip, LPS", [](const RootRow & r) { return r.record.tip[0]; } },
  { "tip_y", "mm", "tip, LPS", [](const RootRow & r) { return r.record.tip[1]; } },
  { "tip_z", "mm", "tip, LPS", [](const RootRow & r) { return r.record.tip[2]; } },
});

constexpr auto kRootNames = std::to_array<Column>({
  { "name", "", "given to the root by --edits" },
});

constexpr auto kLevelColumns = std::to_array<ValueColumn<RootLevelRecord>>({
  { "count", "", "number of roots", [](const RootLevelRecord & r) { return static_cast<double>(r.count); } },
  { "total_length", "mm", "sum over roots", [](const RootLevelRecord & r) { return r.totalLength; } },
  { "mean_length", "mm", "mean over roots", [](const RootLevelRecord & r) { return r.meanLength; } },
  { "mean_diameter",
    "mm",
    "mean over roots, weighted by length",
    [](const RootLevelRecord & r) { return r.meanDiameter; } },
  { "mean_tortuosity", "1", "mean over roots", [](const RootLevelRecord & r) { return r.meanTortuosity; } },
  { "mean_emergence_angle",
    "deg",
    "mean over roots of emergence_angle",
    [](const RootLevelRecord & r) { return r.meanEmergenceAngle; } },
  { "mean_midpoint_angle",
    "deg",
    "mean over roots of midpoint_angle",
    [](const RootLevelRecord & r) { return r.meanMidpointAngle; } },
  { "mean_tip_angle", "deg", "mean over roots of tip_angle", [](const RootLevelRecord & r) { return r.meanTipAngle; } },
  { "mean_emergence_from_down",
    "deg",
    "mean over roots of emergence_from_down",
    [](const RootLevelRecord & r) { return r.meanEmergenceFromDown; } },
  { "mean_midpoint_from_down",
    "deg",
    "mean over roots of midpoint_from_down",
    [](const RootLevelRecord & r) { return r.meanMidpointFromDown; } },
  { "mean_tip_from_down",
    "deg",
    "mean over roots of tip_from_down",
    [](const RootLevelRecord & r) { return r.meanTipFromDown; } },
  { "mean_children", "", "mean over roots of children", [](const RootLevelRecord & r) { return r.meanChildren; } },
  { "volume", "mm^3", "sum over roots", [](const RootLevelRecord & r) { return r.volume; } },
  { "surface", "mm^2", "sum over roots", [](const RootLevelRecord & r) { return r.surface; } },
});

constexpr auto kLevelHead = std::to_array<Column>({
  { "level", "", "0 stems, 1 their laterals, and so on; laterals: all but stems; all" },
});

constexpr auto kPlantHead = std::to_array<Column>({
  { "scan", "", "name of the scan" },
});

/** The plant with what only the voxels know. */
struct PlantRow
{
  const RootTraits & traits;
  double             volume;
};

constexpr auto kPlantColumns = std::to_array<ValueColumn<PlantRow>>({
  { "roots",
    "",
    "number of roots, stems among them",
    [](const PlantRow & r) { return static_cast<double>(r.traits.roots.size()); } },
  { "stems", "", "number of stems", [](const PlantRow & r) { return static_cast<double>(r.traits.stems); } },
  { "stem_length", "mm", "of all stems", [](const PlantRow & r) { return r.traits.stemLength; } },
  { "stem_diameter", "mm", "mean along them", [](const PlantRow & r) { return r.traits.stemDiameter; } },
  { "total_length",
    "mm",
    "of all roots",
    [](const PlantRow & r) { return r.traits.levels.empty() ? 0 : r.traits.levels.back().totalLength; } },
  { "volume", "mm^3", "of the voxels", [](const PlantRow & r) { return r.volume; } },
  { "surface",
    "mm^2",
    "of the round cones along all roots",
    [](const PlantRow & r) { return r.traits.levels.empty() ? 0 : r.traits.levels.back().surface; } },
  { "depth",
    "mm",
    "from the highest point of the centre lines to the deepest",
    [](const PlantRow & r) { return r.traits.depth; } },
  { "width",
    "mm",
    "greatest distance across down between points of the centre lines",
    [](const PlantRow & r) { return r.traits.width; } },
  { "hull_volume",
    "mm^3",
    "of the convex hull of the centre lines",
    [](const PlantRow & r) { return r.traits.hullVolume; } },
  { "hull_surface", "mm^2", "of the same", [](const PlantRow & r) { return r.traits.hullSurface; } },
  { "whorls",
    "",
    "places of a stem that three roots or more spring from",
    [](const PlantRow & r) { return static_cast<double>(r.traits.whorls); } },
  { "whorl_distance",
    "mm",
    "along the stem from one whorl to the next, mean",
    [](const PlantRow & r) { return r.traits.meanWhorlDistance; } },
  { "contacts",
    "",
    "places where roots touch",
    [](const PlantRow & r) { return static_cast<double>(r.traits.contacts); } },
  { "undecided_contacts",
    "",
    "contacts that could be paired otherwise",
    [](const PlantRow & r) { return static_cast<double>(r.traits.undecidedContacts); } },
  { "soil_depth",
    "mm",
    "of the soil below the base of the first stem, as given",
    [](const PlantRow & r) { return r.traits.soilDepth.value_or(kNone); } },
  { "roots_above_soil",
    "",
    "roots that spring above the soil plane",
    [](const PlantRow & r) { return r.traits.soilDepth ? static_cast<double>(r.traits.rootsAboveSoil) : kNone; } },
  { "roots_below_soil",
    "",
    "roots that spring below it",
    [](const PlantRow & r) { return r.traits.soilDepth ? static_cast<double>(r.traits.rootsBelowSoil) : kNone; } },
  { "whorls_above_soil",
    "",
    "whorls above the soil plane",
    [](const PlantRow & r) { return r.traits.soilDepth ? static_cast<double>(r.traits.whorlsAboveSoil) : kNone; } },
  { "whorls_below_soil",
    "",
    "whorls below it",
    [](const PlantRow & r) { return r.traits.soilDepth ? static_cast<double>(r.traits.whorlsBelowSoil) : kNone; } },
});

/** A class of depth and one of diameter. */
struct ProfileRow
{
  const RootDepthRecord &    depth;
  const RootDiameterRecord & diameter;
};

constexpr auto kProfileColumns = std::to_array<ValueColumn<ProfileRow>>({
  { "depth",
    "mm",
    "middle of a slice across down, below the base of the first stem",
    [](const ProfileRow & r) { return r.depth.depth; } },
  { "length_at_depth", "mm", "of the roots in the slice", [](const ProfileRow & r) { return r.depth.length; } },
  { "width_at_depth",
    "mm",
    "greatest distance between centre lines in the slice",
    [](const ProfileRow & r) { return r.depth.width; } },
  { "diameter_from", "mm", "lower end of a class of diameters", [](const ProfileRow & r) { return r.diameter.from; } },
  { "diameter_to", "mm", "its upper end", [](const ProfileRow & r) { return r.diameter.to; } },
  { "length_of_diameter",
    "mm",
    "of the roots with these diameters",
    [](const ProfileRow & r) { return r.diameter.length; } },
});

template <typename Columns, typename Row>
void
WriteRow(TextFile & file, const Columns & columns, const Row & row)
{
  for (std::size_t i = 0; i < columns.size(); ++i)
  {
    file << (i > 0 ? "," : "") << columns[i].value(row);
  }
  file << "\n";
}

} // namespace

void
WriteRootCsv(const std::filesystem::path & path, const RootModel & model, HeadUnits units)
{
  TextFile file(path, tableDigits);
  for (const auto & column : kRootColumns)
  {
    file << HeadOf(column, units) << ",";
  }
  file << HeadLine(kRootNames, units);
  for (std::size_t root = 0; root < model.traits.roots.size(); ++root)
  {
    const RootRow row{ root, model.roots.axes[root], model.traits.roots[root] };
    for (const auto & column : kRootColumns)
    {
      file << column.value(row) << ",";
    }
    file << CsvField(row.axis.name) << "\n";
  }
  file.Finish();
}

void
WriteRootLevelCsv(const std::filesystem::path & path, const RootModel & model, HeadUnits units)
{
  TextFile file(path, tableDigits);
  file << kLevelHead[0].name << ",";
  file << HeadLine(kLevelColumns, units);
  for (const RootLevelRecord & level : model.traits.levels)
  {
    using Kind = RootLevelRecord::Kind;
    file << (level.kind == Kind::All        ? std::string("all")
             : level.kind == Kind::Laterals ? std::string("laterals")
                                            : std::to_string(level.level))
         << ",";
    WriteRow(file, kLevelColumns, level);
  }
  file.Finish();
}

void
WritePlantCsv(const std::filesystem::path & path, const RootModel & model, double volume, HeadUnits units)
{
  TextFile file(path, tableDigits);
  file << kPlantHead[0].name << ",";
  file << HeadLine(kPlantColumns, units);
  file << CsvField(model.name) << ",";
  WriteRow(file, kPlantColumns, PlantRow{ model.traits, volume });
  file.Finish();
}

std::string
PlantJson(const RootModel & model, double volume)
{
  const PlantRow row{ model.traits, volume };
  std::string    json;
  for (const auto & column : kPlantColumns)
  {
    const double value = column.value(row);
    if (!std::isfinite(value))
    {
      continue;
    }
    std::string unit = InUnit(column.unit, model.unit);
    std::erase(unit, '^');
    char text[40];
    (void)std::snprintf(text, sizeof(text), "%.9g", value);
    json +=
      (json.empty() ? "\"" : ", \"") + std::string(column.name) + (unit.empty() ? "" : "_" + unit) + "\": " + text;
  }
  return "{ " + json + " }";
}

void
WriteRootProfileCsv(const std::filesystem::path & path, const RootModel & model, HeadUnits units)
{
  TextFile file(path, tableDigits);
  file << HeadLine(kProfileColumns, units);
  const std::size_t rows = std::min(model.traits.depths.size(), model.traits.diameters.size());
  for (std::size_t i = 0; i < rows; ++i)
  {
    WriteRow(file, kProfileColumns, ProfileRow{ model.traits.depths[i], model.traits.diameters[i] });
  }
  file.Finish();
}

std::string
RootColumnsJson(SpatialUnit unit)
{
  return TablesJson({ { "roots", ColumnsJson(kRootColumns, unit, kRootNames) },
                      { "levels", ColumnsJson(kLevelHead, unit, kLevelColumns) },
                      { "plant", ColumnsJson(kPlantHead, unit, kPlantColumns) },
                      { "profile", ColumnsJson(kProfileColumns, unit) },
                      { "annotations", ColumnsJson(kAnnotationColumns, unit) } });
}

} // namespace voxelcore
