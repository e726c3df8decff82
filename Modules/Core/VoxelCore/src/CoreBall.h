#pragma once
// What pruning by tolerance asks of the vertices of a core again and again.

#include "voxelcore/Complex/CellComplex.h"
#include "voxelcore/Lattice/LatticePoint.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace voxelcore
{

using BallCentre = std::array<double, 3>; ///< mm

inline constexpr ElementIndex kNobody = 0xFFFFFFFFU;

/** The ball of a vertex, in one line of the cache with what becomes of it. Lengths in mm. The fire (RimFire) changes
 *  its own two members only, and what looks after loose ends (LooseEnds) the others, at the same time. */
struct alignas(64) CoreBall
{
  BallCentre   centre;
  double       radius;
  double       burnt = 0;           ///< when fire reached it
  double       bound = 0;           ///< none of the boundary vertices it keeps is farther from it
  ElementIndex witness = kNobody;   ///< the ball that fire came with
  ElementIndex uphill = kNobody;    ///< the neighbour towards which the radius grows most steeply; itself at a top;
                                    ///< kNobody: not asked
  std::uint32_t lastKept = kNobody; ///< of the ring of boundary vertices it keeps
  std::uint32_t seen = 0;           ///< number of the last look around that came by
};
static_assert(sizeof(CoreBall) == 64);

inline double
SquaredDistance(const BallCentre & p, const BallCentre & q)
{
  const double dx = p[0] - q[0];
  const double dy = p[1] - q[1];
  const double dz = p[2] - q[2];
  return dx * dx + dy * dy + dz * dz;
}

/** Of a boundary vertex, mm, and what its gaps are to be multiplied by (ToleranceWeights.h). */
struct WeighedPlace
{
  BallCentre place;
  double     weight;
};

/** mm from the first boundary vertex, as TouchingBalls has it; `scale`: mm a lattice step. */
inline BallCentre
PlaceFromFirst(const LatticePoint & p, const LatticePoint & first, const BallCentre & scale)
{
  return { scale[0] * (p.x - first.x), scale[1] * (p.y - first.y), scale[2] * (p.z - first.z) };
}

/** How far a boundary vertex lies from the ball of y, weighed. */
inline double
Gap(const WeighedPlace & at, const CoreBall & y)
{
  return at.weight * (std::sqrt(SquaredDistance(at.place, y.centre)) - y.radius);
}

/** Which boundary vertices each ball touches, where they are weighed: else what sticks out says enough. */
struct TouchedPlaces
{
  std::vector<WeighedPlace>      places;
  std::span<const std::uint32_t> offsets; ///< balls + 1
  std::span<const std::uint32_t> touched; ///< indices of places
  double                         largestWeight = 1;

  bool
  AreWeighed() const
  {
    return !places.empty();
  }

  /** The greatest gap from the ball of y to what a ball touches; one that is at least `enough` where there is one. */
  double
  WorstGap(ElementIndex ball, const CoreBall & y, double enough) const
  {
    double worst = -HUGE_VAL;
    for (std::uint32_t i = offsets[ball]; i < offsets[ball + 1] && worst < enough; ++i)
    {
      const double gap = Gap(places[touched[i]], y);
      worst = worst < gap ? gap : worst;
    }
    return worst;
  }
};

/** By how much the ball of x sticks out of the ball of y. */
inline double
Protrusion(const CoreBall & x, const CoreBall & y)
{
  return std::sqrt(SquaredDistance(x.centre, y.centre)) + (x.radius - y.radius);
}

/** Two lengths that are computed side by side, each as it would be alone. */
using TwoLengths = double __attribute__((vector_size(16)));

/** What is asked of two balls at once. */
struct TwoBalls
{
  TwoBalls(const CoreBall & a, const CoreBall & b)
    : x{ a.centre[0], b.centre[0] }
    , y{ a.centre[1], b.centre[1] }
    , z{ a.centre[2], b.centre[2] }
    , radius{ a.radius, b.radius }
  {}
  TwoLengths x;
  TwoLengths y;
  TwoLengths z;
  TwoLengths radius;
};

inline TwoLengths
Larger(const TwoLengths & a, const TwoLengths & b)
{
  return a < b ? b : a;
}

/** Protrusion() of each out of the ball of y. */
inline TwoLengths
Protrusions(const TwoBalls & balls, const CoreBall & y)
{
  const TwoLengths dx = balls.x - y.centre[0];
  const TwoLengths dy = balls.y - y.centre[1];
  const TwoLengths dz = balls.z - y.centre[2];
  const TwoLengths squared = dx * dx + dy * dy + dz * dz;
  return TwoLengths{ std::sqrt(squared[0]), std::sqrt(squared[1]) } + (balls.radius - y.radius);
}

} // namespace voxelcore
