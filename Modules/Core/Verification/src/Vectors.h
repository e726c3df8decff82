#pragma once
// Vectors in lattice axes scaled by the weights, where lengths are distances. Verification has its own, in a namespace
// of its own: it shares no arithmetic with what it checks.

#include "voxelcore/Lattice/SpacingWeights.h"

#include <array>
#include <cmath>

namespace voxelcore::verification
{

using Position = std::array<double, 3>;

inline Position
Minus(const Position & a, const Position & b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

inline double
Dot(const Position & a, const Position & b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Position
Cross(const Position & a, const Position & b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

inline double
Length(const Position & a)
{
  return std::sqrt(Dot(a, a));
}

/** How far a point may be from where it should, in units of SpacingWeights::unit, when each of its lattice coordinates
 *  may be off by `tolerance`. */
inline double
Reach(const SpacingWeights & weights, double tolerance)
{
  return tolerance * Length({ static_cast<double>(weights.weight[0]),
                              static_cast<double>(weights.weight[1]),
                              static_cast<double>(weights.weight[2]) });
}

} // namespace voxelcore::verification
