#pragma once
// Numbers of local thickness as tables.

#include "voxelcore/Base/SpatialUnit.h"
#include "voxelcore/Models/DisplayContent.h"
#include "voxelcore/Models/TableHead.h"
#include "voxelcore/Thickness/ThicknessNumbers.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace voxelcore
{

/** Of one label, or of the background that separates its parts. Lengths in mm, or in voxels. */
struct ThicknessRecord
{
  std::int64_t          label = 0;
  std::int64_t          component = 0; ///< from 1 for a label split into its components; 0: the whole label
  std::string           name;
  bool                  isSeparation = false;
  double                voxelVolume = 1;
  ThicknessNumbers      numbers;               ///< of all voxels that count
  std::uint64_t         borderVoxels = 0;      ///< whose ball touches the border of what was scanned
  ThicknessNumbers      inner;                 ///< of the other voxels
  bool                  withoutBorder = false; ///< whether `numbers` leaves out those at the border
  std::optional<double> meanLower;             ///< of the proven bounds, where these were asked for
  std::optional<double> meanUpper;
  std::uint64_t         outside = 0;         ///< voxels outside these bounds, where these are of smooth surfaces
  double                farthestOutside = 0; ///< how far at most

  std::array<std::int32_t, 3> parts{ 1, 1, 1 }; ///< of a voxel along each axis, for these bounds (FineBracket.h)
};

/** A row per record. \throws OutputError */
void
WriteThicknessCsv(const std::filesystem::path &        path,
                  const std::vector<ThicknessRecord> & records,
                  HeadUnits                            units = {});

/** A row per record and bin. \throws OutputError */
void
WriteThicknessHistogramCsv(const std::filesystem::path &        path,
                           const std::vector<ThicknessRecord> & records,
                           HeadUnits                            units = {});

/** The surface of a label with a length at each point. */
struct ThicknessSurface
{
  std::int64_t        label = 0;
  std::int64_t        component = 0;
  LabelSurfaceMesh    surface;
  std::vector<double> thickness; ///< per point, mm
};

/** .vtp: triangles with the point array `Thickness` and the cell arrays `Label` and `Component`. \throws OutputError */
void
WriteThicknessVtp(const std::filesystem::path &         path,
                  const std::vector<ThicknessSurface> & surfaces,
                  SpatialUnit                           unit,
                  const std::string &                   provenance);

/** The data dictionary of both tables as JSON: meaning and unit of each column. */
std::string
ThicknessColumnsJson(SpatialUnit unit);

} // namespace voxelcore
