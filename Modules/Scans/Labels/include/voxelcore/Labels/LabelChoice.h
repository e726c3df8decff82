#pragma once
// Which values of a scan become shapes.

#include "voxelcore/Labels/CropRange.h"

#include <optional>
#include <string>
#include <utility>

namespace voxelcore
{

/** A combination without sense is a UsageError. */
struct LabelChoice
{
  std::string                              labels = "all";       ///< "all", or values or names separated by commas
  bool                                     binary = false;       ///< all values chosen are one shape, label 1
  std::optional<std::pair<double, double>> threshold;            ///< grey scan: lo <= value <= hi is one shape
  std::optional<CropRange>                 crop;                 ///< the part of the scan to look at
  bool                                     refuseGrey = false;   ///< see GreyScan.h; unless all is one shape
  bool                                     mayBeMissing = false; ///< labels without a voxel in the part are no error
};

} // namespace voxelcore
