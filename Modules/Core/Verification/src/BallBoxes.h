#pragma once
// The ball nearest to a place, found by other means than those that make cores.

#include "voxelcore/Lattice/SpacingWeights.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace voxelcore::verification
{

/** Balls in the order of a space-filling curve, eight to a box, eight boxes to a greater one, and so on: no ball of a
 *  box is nearer to a place than the box of their centres less the largest radius. 37 bytes a ball. */
class BallBoxes
{
public:
  /** Centres in lattice coordinates, radii in mm; fewer than 2^32 balls. */
  BallBoxes(std::span<const std::array<double, 3>> positions,
            std::span<const double>                radius,
            const SpacingWeights &                 weights);

  /** Smallest of |place - centre| - radius over all balls, in mm; infinity without balls. Once a gap below `enough` is
   *  found, it is returned. Looks at ball `likely` first, 0 to begin with, and leaves there the one it found; these are
   *  numbers of its own. Place in lattice coordinates. Thread-safe. */
  double
  SmallestGap(const std::array<double, 3> & place, double enough, std::size_t & likely) const;

  /** Whether the gap to one ball is below `most`. */
  bool
  IsNearer(const std::array<double, 3> & place, double most, std::size_t number) const;

  /** Of one ball, mm; its centre in lattice coordinates times the scale of each axis. */
  std::array<double, 3>
  Centre(std::size_t number) const;
  double
  Radius(std::size_t number) const
  {
    return m_Balls[number / kInABox].radius[number % kInABox];
  }

private:
  static constexpr std::size_t kInABox = 8;

  /** What lies in a box, side by side, so that a processor looks at several at once. */
  struct Balls
  {
    std::array<std::array<double, kInABox>, 3> centre; ///< mm
    std::array<double, kInABox>                radius;
  };
  struct Boxes ///< rounded outwards
  {
    std::array<std::array<float, kInABox>, 3> lower; ///< of the balls' centres, mm
    std::array<std::array<float, kInABox>, 3> upper;
    std::array<float, kInABox>                radius; ///< the largest
  };
  struct Search;

  std::array<double, 3>
  InMm(const std::array<double, 3> & place) const;
  void
  Look(Search & search, std::size_t box) const;
  void
  MakeBoxes();

  std::array<double, 3>           m_Scale; ///< mm a lattice unit
  std::vector<Balls>              m_Balls; ///< by the smallest boxes; after the last ball come some of radius -infinity
  std::vector<std::vector<Boxes>> m_Levels; ///< of the smallest boxes first, by the greater box they lie in
};

} // namespace voxelcore::verification
