#pragma once
// Exact predicates and spheres on the weighted lattice (DESIGN: distance^2 = sum of w^2 d^2). Integers only.
//
// Bounds, with N the largest difference of two coordinates among the points and w the greatest weight:
//   2 x 2 minors <= 2 N^2, determinant <= 6 N^3, weighted squared length s <= 3 w^2 N^2,
//   sphere coefficients <= 3 * s * minor = 18 w^2 N^4, in-sphere value <= 6 N^3 * s + 3 * 18 w^2 N^5 = 72 w^2 N^5.
// ExactRangeAllows() holds the last one below 2^127; where a derived quantity can still be longer, it is computed with
// arbitrary precision.

#include "voxelcore/Lattice/LatticePoint.h"
#include "voxelcore/Lattice/Rational.h"
#include "voxelcore/Lattice/SpacingWeights.h"

#include <array>
#include <span>

namespace voxelcore
{

/** Bits of the in-sphere bound 72 w^2 N^5 for point sets that extend over `extent` lattice steps. */
double
InSphereBits(std::int64_t extent, const SpacingWeights & weights);

/** Whether point sets that extend over `extent` lattice steps stay in the exact range: 72 w^2 N^5 < 2^127. */
bool
ExactRangeAllows(std::int64_t extent, const SpacingWeights & weights);

/** Squared weighted distance, in unit^2. */
Int128
SquaredDistance(const LatticePoint & a, const LatticePoint & b, const SpacingWeights & weights);

/** det(b - a, c - a, d - a), six times the signed volume in unweighted lattice steps. */
Int128
Orientation(const LatticePoint & a, const LatticePoint & b, const LatticePoint & c, const LatticePoint & d);

/** The sphere through four affinely independent points. Its centre is base + n / (2 det w^2) per axis; det > 0. */
struct CircumSphere
{
  LatticePoint          base{};
  std::array<Int128, 3> n{};
  Int128                det = 0; ///< 0 when the four points are coplanar: then there is no sphere
};

CircumSphere
MakeCircumSphere(const LatticePoint &   a,
                 const LatticePoint &   b,
                 const LatticePoint &   c,
                 const LatticePoint &   d,
                 const SpacingWeights & weights);

/** det * (squared distance of `point` from the centre - squared radius): negative inside, 0 on, positive outside. */
Int128
Power(const CircumSphere & sphere, const LatticePoint & point, const SpacingWeights & weights);

/** Lattice coordinate of the centre along an axis, rounded once. */
double
CentreCoordinate(const CircumSphere & sphere, std::size_t axis, const SpacingWeights & weights);

/** Exact sign of the difference of two centres' coordinates along an axis. */
int
CompareCentreCoordinates(const CircumSphere &   a,
                         const CircumSphere &   b,
                         std::size_t            axis,
                         const SpacingWeights & weights);

/** Squared radius in unit^2, rounded once. */
double
SquaredRadius(const CircumSphere & sphere, const SpacingWeights & weights);

/** Squared radius of the circle through three points that are not collinear, in unit^2, rounded once. */
double
SquaredCircumradius(const LatticePoint &   a,
                    const LatticePoint &   b,
                    const LatticePoint &   c,
                    const SpacingWeights & weights);

/** Seen from `apex`: positive when the centre of the sphere through a, b, c and apex lies on apex' side of the plane
 *  abc, 0 when it lies on the plane, negative beyond. That is the sign of apex' power with respect to the smallest
 *  sphere through a, b, c. */
int
CentreSide(const LatticePoint &   a,
           const LatticePoint &   b,
           const LatticePoint &   c,
           const LatticePoint &   apex,
           const SpacingWeights & weights);

/** Sign of (a - corner) . (b - corner): negative when the angle at `corner` is obtuse in the weighted metric. */
int
AngleSign(const LatticePoint & corner, const LatticePoint & a, const LatticePoint & b, const SpacingWeights & weights);

} // namespace voxelcore
