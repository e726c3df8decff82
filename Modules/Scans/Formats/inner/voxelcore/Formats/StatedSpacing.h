#pragma once
// The voxel size as far as a file states it, and what is assumed of the rest.

#include "voxelcore/Formats/ScanFile.h"

#include <array>
#include <optional>
#include <string>

namespace voxelcore
{

struct StatedSpacing
{
  std::array<std::optional<double>, 3> mm;       ///< along i, j, k
  std::string                          source{}; ///< "ImageJ", "OME-XML", "resolution tags (1000 dots a cm)", ...
  std::string                          note{};   ///< why something in the file was not taken for a voxel size

  bool
  operator==(const StatedSpacing &) const = default;
};

/** The scan's unit is the voxel, which is told as a warning; gives the spacing, 1. */
Vector3
SpacingInVoxels(ScanFile & scan);

/** The spacing for SetGeometry(), which takes options.spacing instead where there is one. What is not stated is warned
 *  of: k is then as i (cubic voxels), and where i or j is not stated the scan's unit is the voxel. Tells the scan's
 *  notes where the rest is from. */
Vector3
CompleteSpacing(const StatedSpacing & stated, const ReadOptions & options, ScanFile & scan);

} // namespace voxelcore
