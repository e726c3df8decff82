#pragma once
// Surfaces and lines that say nothing of how they were made: meshes, and what other programs saved without field data.

#include "voxelcore/VoxelCore/MedialComplex.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace voxelcore
{

struct PlainSurface
{
  MedialComplex surface;           ///< polygons, and the edges of lines; in the file's unit, LPS; measures are 0
  bool          hasRadius = false; ///< its point array Radius is there; else radii are 0
};

/** What a file shows: .vtp and .vtk in any encoding, .ply .stl .obj .off. Empty where it has a field Provenance, so
 *  that it is to be read as VoxelCore's. Of triangle strips and of polygons in .ply, .stl, .obj and .off the triangles.
 *  \throws InputError when it is missing or damaged, or holds neither polygons nor lines */
std::optional<PlainSurface>
ReadPlainSurface(const std::filesystem::path & path);

/** A sheet or rod of a file that WriteSheetsVtp() wrote. */
struct SheetSurface
{
  std::int64_t        id = 0;
  PlainSurface        plain;
  std::vector<double> thickness; ///< per vertex
};

struct SheetSurfaces
{
  std::vector<SheetSurface> sheets; ///< by id; seams, which bound them, are none
  std::string               provenance;
};

/** Empty where the file has no cell array SheetId. \throws InputError when it is missing or damaged */
std::optional<SheetSurfaces>
ReadSheetSurfaces(const std::filesystem::path & path);

/** The surface of a label, or of a component of it, in a file of 'thickness --surface'. */
struct MeasuredSurface
{
  std::int64_t        label = 0;
  std::int64_t        component = 0; ///< 0 for a whole label
  PlainSurface        plain;         ///< without radii
  std::vector<double> thickness;     ///< per vertex
};

struct MeasuredSurfaces
{
  std::vector<MeasuredSurface> surfaces; ///< by label and component
  std::string                  provenance;
};

/** Empty where the file has no point array Thickness, or has radii, as medial surfaces do.
 *  \throws InputError when it is missing or damaged */
std::optional<MeasuredSurfaces>
ReadMeasuredSurfaces(const std::filesystem::path & path);

} // namespace voxelcore
