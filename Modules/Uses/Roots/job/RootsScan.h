#pragma once
// The mask of a root system, from a scan of labels or of grey values, cleaned.

#include "voxelcore/Jobs/CoreJob.h"

#include <optional>
#include <string>
#include <vector>

namespace voxelcore
{

/** A mask as it is before roots are told apart. */
struct CleanMask
{
  ImageGeometry           geometry;
  std::optional<VoxelBox> scan; ///< what was read; none of a mesh
  EditedLabels            edited;
};

/** Chooses the threshold of grey values that come without one, and how hollows are filled. */
CleanMask
LookAtScan(CoreOptions & core, bool asIs, std::vector<std::string> & notes);

} // namespace voxelcore
