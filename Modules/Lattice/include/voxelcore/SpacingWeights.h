#pragma once
// Integer weights in the ratio of the voxel's sides: they make distances on an anisotropic lattice exact integers.

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

/** The smallest integer weights whose ratios match those of the spacings (mm, all > 0) within a relative error of
 *  1e-6; else the best ones up to 4096, with their deviation.
 *  \throws InputError when a spacing is not finite and positive. */
SpacingWeights
ComputeSpacingWeights(const std::array<double, 3> & spacing);

} // namespace voxelcore
