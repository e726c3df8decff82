#pragma once
// What a caller says of a scan that its file leaves open.

#include "voxelcore/Formats/RawLayout.h"
#include "voxelcore/Labels/LabelChoice.h"
#include "voxelcore/Lattice/CheckedGeometry.h"

#include <cstdint>
#include <optional>
#include <string>

namespace voxelcore
{

/** How a mesh becomes voxels. */
struct MeshReading
{
  bool cap = false;   ///< close its holes first
  bool cover = false; ///< take the voxels that it touches, too
};

/** How to read. A combination without sense is a UsageError. */
struct ReadOptions
  : LabelChoice
  , GeometryOptions
{
  std::string                 niftiForm = "auto"; ///< "auto" (ITK's rule), "sform" or "qform"
  std::optional<std::int64_t> volume;             ///< which volume of a 4-D file, counted from 0
  std::optional<std::int64_t> component;          ///< which of several values a voxel, from 0
  std::optional<std::int64_t> level;              ///< which resolution of an OME-Zarr image, from 0, the finest
  std::optional<std::string>  dataset;            ///< an array of an HDF5 or .vti file
  MeshReading                 mesh{};
  std::optional<RawLayout>    raw; ///< the file is bare voxels of this layout, whatever its name
};

} // namespace voxelcore
