#include "voxelcore/Vessels/StraightTables.h"

#include "voxelcore/Models/TableColumns.h"

#include <array>

namespace voxelcore
{

namespace
{

constexpr int kPlaceDigits = 10; // by which points are mapped

constexpr auto kPlaneColumns = std::to_array<Column>({
  { "plane", "", "slice of the straight volume, from 0" },
  { "arc_length", "mm", "along the axis: third coordinate of the straight volume" },
  { "x", "mm", "place on the axis, LPS" },
  { "y", "mm", "" },
  { "z", "mm", "" },
  { "across_x", "1", "first axis of the straight volume, LPS" },
  { "across_y", "1", "" },
  { "across_z", "1", "" },
  { "up_x", "1", "second axis of the straight volume, LPS" },
  { "up_y", "1", "" },
  { "up_z", "1", "" },
  { "along_x", "1", "direction of the axis, LPS" },
  { "along_y", "1", "" },
  { "along_z", "1", "" },
  { "radius", "mm", "of the skeleton there" },
  { "bend_radius", "mm", "of the axis; planes cross farther in than this; empty where it is straight" },
  kBranchIdColumn,
});

constexpr auto kPointColumns = std::to_array<Column>({
  { "x", "mm", "place in the scan, LPS" },
  { "y", "mm", "" },
  { "z", "mm", "" },
  { "across", "mm", "first coordinate in the straight volume; empty: no plane holds the point" },
  { "up", "mm", "second coordinate" },
  { "arc_length", "mm", "third coordinate" },
  { "in_volume", "", "1: it lies in the straight volume" },
});

} // namespace

void
WritePlaneCsv(const std::filesystem::path & path, std::span<const AxisPlane> planes, HeadUnits units)
{
  TextFile file(path, kPlaceDigits);
  file << HeadLine(kPlaneColumns, units);
  for (std::size_t i = 0; i < planes.size(); ++i)
  {
    const AxisPlane & plane = planes[i];
    file << i << "," << plane.arc;
    for (const Vector3 & one : { plane.place, plane.across, plane.up, plane.along })
    {
      file << "," << one[0] << "," << one[1] << "," << one[2];
    }
    file << "," << plane.radius << "," << 1 / plane.bend << "," << plane.branch << "\n";
  }
  file.Finish();
}

void
WriteMappedCsv(const std::filesystem::path & path, std::span<const MappedPoint> points, HeadUnits units)
{
  TextFile file(path, kPlaceDigits);
  file << HeadLine(kPointColumns, units);
  for (const MappedPoint & point : points)
  {
    file << point.place[0] << "," << point.place[1] << "," << point.place[2];
    for (std::size_t k = 0; k < 3; ++k)
    {
      file << ",";
      if (point.straight)
      {
        file << (*point.straight)[k];
      }
    }
    file << "," << (point.isInVolume ? 1 : 0) << "\n";
  }
  file.Finish();
}

std::string
StraightColumnsJson(SpatialUnit unit)
{
  return TablesJson({ { "planes", ColumnsJson(kPlaneColumns, unit) }, { "points", ColumnsJson(kPointColumns, unit) } });
}

} // namespace voxelcore
