#pragma once
// Integer weights in the ratio of the voxel's sides: they make distances on an anisotropic lattice exact integers.

#include "voxelcore/Lattice/ImageGeometry.h"

#include <array>
#include <cstdint>

namespace voxelcore
{

/** distance^2 of two lattice points = sum over the axes of weight^2 * difference^2, in units of `unit`^2. */
struct SpacingWeights
{
  std::array<std::int64_t, 3> weight{ 1, 1, 1 };
  double                      unit = 1.0;      ///< mm a unit of length: the geometric mean of spacing / weight
  double                      deviation = 0.0; ///< largest relative error of a ratio of weights against spacings
};

/** No weights deviate more than this: a radius is then off by less than a thousandth of itself. */
inline constexpr double kLargestDeviation = 1e-3;

/** The smallest integer weights whose ratios match those of the spacings (mm) within a relative error of 1e-6; else the
 *  best ones up to 4096, with their deviation.
 *  \throws InputError when a spacing is not between 1e-12 and 1e12 mm, or when the best weights deviate by more than
 *  kLargestDeviation, as they do where one spacing is over 4100 times another. */
SpacingWeights
ComputeSpacingWeights(const std::array<double, 3> & spacing);

/** The weights of an image's lattice. Whoever computes a core for an image takes them from here.
 *  \throws InputError as above, and as RequireDistinctPositions does. */
SpacingWeights
ComputeLatticeWeights(const ImageGeometry & geometry);

} // namespace voxelcore
