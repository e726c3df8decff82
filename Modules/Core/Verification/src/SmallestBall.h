#pragma once
// The smallest ball enclosing a few points.

#include <array>
#include <span>

namespace voxelcore::verification
{

/** Squared radius of the smallest ball that encloses the points (E. Welzl 1991, the nested-loop form). The points are
 *  few, lie on one sphere, and have integer coordinates: no three are collinear, and what is coplanar is cocircular, so
 *  support sets never degenerate beyond rounding. Relative error about 1e-12. */
double
SmallestBallSquaredRadius(std::span<const std::array<double, 3>> points);

} // namespace voxelcore::verification
