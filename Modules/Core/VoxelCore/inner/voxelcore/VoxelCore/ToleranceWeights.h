#pragma once
// Tolerance by direction. In thick slices a boundary across them is known to within the distance of two slices, one
// along them to within a fraction of that: a tolerance that is right for the one is far too much for the other.
//
// Across its normal n (unit length) a boundary is uncertain by the voxel's extent along n, e(n) = sum of |n_i| s_i,
// where s is the spacing. A tolerance h is asked for where that is the voxel's diagonal d; where it is less, h counts
// in proportion,
//
//   h(p) = h max(sqrt(3) min s, e(n)) / d,
//
// and no less than for cubes of the least spacing, as the staircase of oblique boundaries has that height at least. For
// cubes this is h everywhere. The weight of a boundary vertex p is h / h(p), at least 1: gap times weight is what is
// compared with h.
//
// The normal is that of the mask smoothed over the thickness of a slice. Along axis i let q be the largest spacing over
// s_i, and w_i the least whole number >= 1 with (2 w_i + 1)^2 >= 6 q^2 - 2, no more than kWidestRun. The mask is summed
// over runs of w_i voxels, twice along each axis, which up to q = 20 has a standard deviation of about q / 2 voxels. Of
// these sums the normal is the gradient at the lattice corner p: along an axis the difference of the two voxels there,
// summed over the two voxels along each of the others. So it is a sum over the 8 w_x w_y w_z voxels about p in whole
// numbers, and only the shape itself counts: the same wherever it lies, and for any number of threads.

#include "voxelcore/Lattice/SpacingWeights.h"
#include "voxelcore/Shape/VoxelShape.h"

#include <cstdint>
#include <vector>

namespace voxelcore
{

/** Voxels that a run has at most. */
inline constexpr std::int64_t kWidestRun = 32;

/** Of boundary vertices of a shape, in their order; empty where voxels are cubes, for which all are 1. Where the
 *  gradient is 0 there is no direction, and the weight is 1. */
std::vector<double>
ToleranceWeights(const VoxelShape & shape, const SpacingWeights & weights, const std::vector<LatticePoint> & points);

} // namespace voxelcore
