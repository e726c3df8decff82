#pragma once
// A stored value after slope and intercept.

#include "voxelcore/Labels/StoredVoxels.h"

namespace voxelcore
{

/** slope * stored + intercept. A slope such as 1/255 is itself rounded (to single precision in NIfTI-1): a product no
 *  further from a whole number than that rounding explains is that number, as long as the rounding is below a hundredth
 *  of the slope: of stored values up to 167772 (2^24 / 100) where the intercept is whole. ITK comes to the same, as it
 *  computes in single precision. */
double
ScaledValue(const StoredVoxels & scan, double stored);

} // namespace voxelcore
