#pragma once
// Centres of spheres through lattice points, as exact fractions.

#include "voxelcore/Lattice/LatticePoint.h"
#include "voxelcore/Lattice/SpacingWeights.h"

#include <array>
#include <cstdint>
#include <optional>

namespace voxelcore::verification
{

__extension__ using Int128 = __int128;

/** centre_a = origin_a + numerator_a / (2 w_a^2 denominator) along axis a; denominator > 0. The sphere passes through
 *  the origin. Numerators stay below 18 w^2 N^4, all products met below 72 w^2 N^5, N the side of the shape's box. */
struct ExactCentre
{
  LatticePoint          origin;
  std::array<Int128, 3> numerator;
  Int128                denominator;
};

/** The sphere through four points; none when they are coplanar. */
std::optional<ExactCentre>
SphereThrough(const std::array<LatticePoint, 4> & points, const SpacingWeights & weights);

/** Positive for a point outside the sphere, 0 on it, negative inside. */
Int128
PowerSign(const ExactCentre & sphere, const LatticePoint & point, const SpacingWeights & weights);

/** Lattice coordinates, each with a relative error of a few roundings of the offset from the origin. */
std::array<double, 3>
Coordinates(const ExactCentre & sphere, const SpacingWeights & weights);

/** The radius in units of SpacingWeights::unit. */
double
Radius(const ExactCentre & sphere, const SpacingWeights & weights);

/** -1, 0, 1: a before, at, after b by x, then y, then z; exact. */
int
CompareCentres(const ExactCentre & a, const ExactCentre & b, const SpacingWeights & weights);

} // namespace voxelcore::verification
