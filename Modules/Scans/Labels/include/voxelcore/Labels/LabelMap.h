#pragma once
// A segmented scan as VoxelCore sees it: geometry, and one voxel shape per label.

#include "voxelcore/Labels/CropRange.h"
#include "voxelcore/Labels/StoredVoxels.h"
#include "voxelcore/Lattice/ImageGeometry.h"
#include "voxelcore/Shape/LabelShape.h"

#include <optional>
#include <string>
#include <vector>

namespace voxelcore
{

/** The labels of a scan, sorted by value. */
struct LabelMap
{
  ImageGeometry            geometry; ///< of the whole scan, also when only a part was read
  std::optional<CropRange> crop;     ///< the part that was asked for, its ends filled in
  std::string              format;   ///< "NRRD", "NIfTI-1", "NIfTI-2", "MetaImage", "TIFF", "TIFF slices", "PNG slices"
  std::string              pixelType; ///< as stored: "uint8", "int16", "float32", ...; "uint1" for packed bits
  std::vector<std::string> notes;     ///< what was assumed or converted, one sentence each; for the report
  std::vector<std::string> warnings;  ///< those of the notes a user must see, each behind the scan's name
  std::vector<LabelShape>  labels;
};

} // namespace voxelcore
