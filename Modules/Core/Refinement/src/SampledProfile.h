#pragma once
// Values along a line across a boundary.

#include <vector>

namespace voxelcore
{

constexpr double kProfileStep = 0.25; ///< from value to value

/** Weights by distance from the centre; beyond its ends a profile goes on as there. */
std::vector<double>
ConvolveProfile(const std::vector<double> & from, const std::vector<double> & weights);

} // namespace voxelcore
