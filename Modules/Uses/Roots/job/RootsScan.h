#pragma once
// The mask of a root system, from a scan of labels or of grey values, cleaned.

#include "voxelcore/Jobs/CoreJobSteps.h"

#include <optional>
#include <string>
#include <vector>

namespace voxelcore
{

/** A mask as it is before roots are told apart. */
struct RootsScan
{
  ScanAtHand                scan;
  std::optional<VoxelShape> plain; ///< what `options.edits` alone make of the scan, where clefts were filled besides
};

/** Chooses the threshold of grey values that come without one, and how hollows are filled. */
RootsScan
LookAtScan(CoreOptions & core, bool asIs, std::vector<std::string> & notes);

} // namespace voxelcore
