#include "NrrdGeometry.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Formats/StatedSpacing.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{
namespace
{

/** +1 or -1 for each coordinate of the file's space: what brings it to LPS. */
Vector3
ToLps(std::string_view field, ScanFile & scan)
{
  std::string space = LowerCase(Trim(field));
  if (space.ends_with("-time"))
  {
    space.resize(space.size() - 5);
  }
  if (space == "left-posterior-superior" || space == "lps" || space == "lpst")
  {
    return { 1, 1, 1 };
  }
  if (space == "right-anterior-superior" || space == "ras" || space == "rast")
  {
    return { -1, -1, 1 };
  }
  if (space == "left-anterior-superior" || space == "las" || space == "last")
  {
    scan.warnings.push_back(
      "the file's space is left-anterior-superior, which ITK 5 and programs built on it (3D "
      "Slicer) place half a turn about the body's axis away from where it belongs");
    return { 1, -1, 1 };
  }
  scan.notes.push_back(field.empty() ? "the file names no anatomical space: its axes are taken as LPS"
                                     : Text("the space '", Printable(field, 30), "' is taken as LPS"));
  return { 1, 1, 1 };
}

/** Millimetres in each unit of a list such as "mm" "mm" "um"; 1 where none is stated. */
Vector3
UnitsInMillimetres(std::string_view                   text,
                   const std::array<std::size_t, 3> & which,
                   const ReadOptions &                options,
                   ScanFile &                         scan)
{
  const auto units = ParseNrrdQuoted(text);
  Vector3    scale{ 1, 1, 1 };
  for (std::size_t a = 0; a < 3; ++a)
  {
    const std::string unit = which[a] < units.size() ? std::string(Trim(units[which[a]])) : std::string();
    if (unit.empty())
    {
      continue;
    }
    if (IsVoxelUnit(unit) && units.size() > 0 && !options.spacing)
    {
      const auto isVoxel = [](const std::string & one) { return IsVoxelUnit(one); };
      if (std::all_of(units.begin(), units.end(), isVoxel) && scan.geometry.unit != SpatialUnit::Voxels)
      {
        SpacingInVoxels(scan);
      }
      if (scan.geometry.unit == SpatialUnit::Voxels)
      {
        continue;
      }
    }
    const auto millimetres = MillimetresIn(unit);
    if (!millimetres && !options.spacing)
    {
      RefuseInput(scan.path,
                  Text("lengths in '", Printable(unit, 20), "', which is no unit known here"),
                  "give the voxel spacing with --spacing X,Y,Z in mm");
    }
    scale[a] = millimetres.value_or(1.0);
  }
  if (scale != Vector3{ 1, 1, 1 })
  {
    scan.notes.push_back(Text("lengths were converted to mm from ", Printable(text)));
  }
  return scale;
}

std::vector<double>
NrrdReals(const std::filesystem::path & path, std::string_view field, std::string_view text, std::size_t count)
{
  const auto values = ParseReals(text);
  if (!values || values->size() != count)
  {
    RefuseInput(path,
                Text("the header field '", field, "' should have ", count, " numbers ('", Printable(text), "')"),
                "mend the header");
  }
  return *values;
}

/** Without space directions: `spacings` along the axes, or the extent `axis mins` to `axis maxs`. */
void
GeometryFromSpacings(const NrrdHeader &  header,
                     const NrrdAxes &    axes,
                     std::size_t         dimension,
                     const ReadOptions & options,
                     ScanFile &          scan)
{
  const std::array<Vector3, 3> identity{ { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } };
  const Vector3                sign = ToLps(header.Field("space"), scan);
  Vector3                      spacing{ 1, 1, 1 };
  Vector3                      origin{ 0, 0, 0 };
  if (const auto text = header.Field("spacings"); !text.empty())
  {
    const auto values = NrrdReals(scan.path, "spacings", text, dimension);
    for (std::size_t a = 0; a < 3; ++a)
    {
      spacing[a] = values[axes.spatial[a]];
    }
    scan.notes.push_back("the file has spacings but no directions: its axes are taken as those of the space");
  }
  else
  {
    spacing = CompleteSpacing({}, options, scan);
  }
  if (const auto text = header.Field("axismins"); !text.empty())
  {
    // As ITK: samples lie in the middle of cells unless the header says they lie on nodes.
    const auto mins = NrrdReals(scan.path, "axis mins", text, dimension);
    const auto centers = Words(header.Field("centers"));
    for (std::size_t a = 0; a < 3; ++a)
    {
      const std::size_t axis = axes.spatial[a];
      const bool        node = axis < centers.size() && LowerCase(centers[axis]) == "node";
      origin[a] = std::isfinite(mins[axis]) ? mins[axis] + (node ? 0.0 : spacing[a] / 2) : 0.0;
    }
  }
  if (const auto text = header.Field("spaceorigin"); !text.empty())
  {
    const auto vectors = ParseNrrdVectors(scan.path, "space origin", text);
    if (vectors.size() == 1 && vectors[0] && vectors[0]->size() >= 3 && std::isfinite((*vectors[0])[0]))
    {
      std::copy_n(vectors[0]->begin(), 3, origin.begin());
    }
  }
  const bool             perAxis = !header.Field("units").empty();
  const Vector3          scale = UnitsInMillimetres(header.Field(perAxis ? "units" : "spaceunits"),
                                           perAxis ? axes.spatial : std::array<std::size_t, 3>{ 0, 1, 2 },
                                           options,
                                           scan);
  std::array<Vector3, 3> directions = identity;
  for (std::size_t a = 0; a < 3; ++a)
  {
    spacing[a] *= scale[a];
    origin[a] *= scale[a] * sign[a];
    directions[a][a] = sign[a];
  }
  SetGeometry(scan, directions, spacing, origin, options);
}

void
GeometryFromDirections(const NrrdHeader &                                      header,
                       const std::vector<std::optional<std::vector<double>>> & steps,
                       const NrrdAxes &                                        axes,
                       const ReadOptions &                                     options,
                       ScanFile &                                              scan)
{
  const Vector3          sign = ToLps(header.Field("space"), scan);
  const Vector3          scale = UnitsInMillimetres(header.Field("spaceunits"), { 0, 1, 2 }, options, scan);
  std::array<Vector3, 3> directions{};
  Vector3                spacing{};
  for (std::size_t a = 0; a < 3; ++a)
  {
    const auto & step = *steps[axes.spatial[a]];
    if (step.size() < 3)
    {
      RefuseInput(scan.path, Text(step.size(), "-D space"), "save it as a volume in three-dimensional space");
    }
    double square = 0;
    for (std::size_t c = 0; c < 3; ++c)
    {
      directions[a][c] = step[c] * sign[c] * scale[c];
      square += directions[a][c] * directions[a][c];
    }
    spacing[a] = std::sqrt(square);
  }
  Vector3    origin{ 0, 0, 0 };
  const auto vectors = ParseNrrdVectors(scan.path, "space origin", header.Field("spaceorigin"));
  if (vectors.size() == 1 && vectors[0] && vectors[0]->size() >= 3)
  {
    for (std::size_t c = 0; c < 3; ++c)
    {
      origin[c] = (*vectors[0])[c] * sign[c] * scale[c];
    }
  }
  else
  {
    scan.notes.push_back("the file states no origin: 0 is taken");
  }
  SetGeometry(scan, directions, spacing, origin, options);
}

} // namespace

void
PlaceNrrd(const NrrdHeader &                                      header,
          const std::vector<std::optional<std::vector<double>>> & directions,
          const NrrdAxes &                                        axes,
          std::size_t                                             dimension,
          const ReadOptions &                                     options,
          ScanFile &                                              scan)
{
  if (directions.empty())
  {
    GeometryFromSpacings(header, axes, dimension, options, scan);
  }
  else
  {
    GeometryFromDirections(header, directions, axes, options, scan);
  }
}

} // namespace voxelcore
