#pragma once
// The ball nearest to a place.

#include "voxelcore/Lattice/SpacingWeights.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace voxelcore
{

/** A balanced kd-tree over balls that finds the one whose surface is nearest to a place. 52 bytes a ball. */
class BallTree
{
public:
  /** Centres in lattice coordinates, radii in mm; up to 2^32 - 2 balls. */
  BallTree(std::span<const std::array<double, 3>> positions,
           std::span<const double>                radius,
           const SpacingWeights &                 weights);

  /** Smallest of |place - centre| - radius over all balls, in mm: negative inside a ball, infinity without balls.
   *  Place in lattice coordinates. Once a ball nearer than `enough` is found, its gap is returned. Thread-safe. */
  double
  Gap(const std::array<double, 3> & place, double enough = -HUGE_VAL) const;
  /** The same, for places next to each other: looks at ball `nearest` first, and leaves there the one found. It is the
   *  tree's own number of a ball, 0 to begin with. */
  double
  Gap(const std::array<double, 3> & place, double enough, std::size_t & nearest) const;

  /** Whether the gap to a ball, by the tree's own number, is less than `most`. Thread-safe. */
  bool
  IsWithin(const std::array<double, 3> & place, double most, std::size_t number) const;

  /** Which ball the tree's own number is of. */
  std::uint32_t
  BallOf(std::size_t number) const
  {
    return m_Balls[number].index;
  }

  /** Gives a ball, by the tree's own number, a radius of at most what it had at first; -infinity takes it out. */
  void
  SetRadius(std::size_t number, double radius)
  {
    m_Balls[number].radius = radius;
  }

  /** The balls whose gap is at most `most`, ascending. Thread-safe. */
  void
  FindWithin(const std::array<double, 3> & place, double most, std::vector<std::uint32_t> & found) const;

private:
  struct Ball
  {
    std::array<double, 3> centre; ///< mm
    double                radius;
    std::uint32_t         index;
  };
  struct Search;

  /** Of the balls first to last - 1, puts the one into the middle that splits them, and says where that is. */
  std::size_t
  Split(std::size_t first, std::size_t last);
  void
  Build(std::size_t first, std::size_t last);
  double
  GapTo(const std::array<double, 3> & place, std::size_t i) const;
  void
  Test(Search & search, std::size_t i) const;
  void
  Descend(Search & search, std::size_t first, std::size_t last, double squared) const;

  std::array<double, 3>     m_Scale;   ///< mm a lattice unit
  std::vector<Ball>         m_Balls;   ///< the middle of each range splits it
  std::vector<double>       m_Largest; ///< radius in the range of which this is the middle
  std::vector<std::uint8_t> m_Axes;    ///< of the split at each middle
};

} // namespace voxelcore
