#pragma once
// What straightening tells beside its volume, as tables.

#include "voxelcore/Base/SpatialUnit.h"
#include "voxelcore/Models/TableHead.h"
#include "voxelcore/Vessels/Straightening.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace voxelcore
{

/** A place in the scan and in the straight volume. */
struct MappedPoint
{
  Vector3                place{};  ///< LPS mm
  std::optional<Vector3> straight; ///< across, up, arc; none where no plane holds it
  bool                   isInVolume = false;
};

/** Comma-separated values, a row per plane: its place, directions, radius and bend. \throws OutputError */
void
WritePlaneCsv(const std::filesystem::path & path, std::span<const AxisPlane> planes, HeadUnits units = {});

/** A row per point. \throws OutputError */
void
WriteMappedCsv(const std::filesystem::path & path, std::span<const MappedPoint> points, HeadUnits units = {});

/** What the columns of both mean, as JSON. */
std::string
StraightColumnsJson(SpatialUnit unit);

} // namespace voxelcore
