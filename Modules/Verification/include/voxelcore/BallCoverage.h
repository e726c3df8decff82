#pragma once
// How well the balls of a medial surface rebuild the boundary they came from: what pruning by tolerance promises,
// measured with a kd-tree over the balls and nothing of what made them.

#include "voxelcore/Progress.h"
#include "voxelcore/SpacingWeights.h"
#include "voxelcore/VoxelShape.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace voxelcore
{

/** A balanced kd-tree over balls that finds the one whose surface is nearest to a place. 44 bytes a ball. */
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

private:
  struct Ball
  {
    std::array<double, 3> centre; ///< mm
    double                radius;
  };
  struct Search;

  void
  Build(std::size_t first, std::size_t last);
  void
  Test(Search & search, std::size_t i) const;
  void
  Descend(Search & search, std::size_t first, std::size_t last, double squared) const;

  std::array<double, 3>     m_Scale;   ///< mm a lattice unit
  std::vector<Ball>         m_Balls;   ///< the middle of each range splits it
  std::vector<double>       m_Largest; ///< radius in the range of which this is the middle
  std::vector<std::uint8_t> m_Axes;    ///< of the split at each middle
};

/** The boundary vertex that lies farthest from the balls. */
struct BoundaryGap
{
  double                      largest = 0; ///< mm; infinity without balls, 0 for an empty shape
  std::array<std::int32_t, 3> place{};     ///< lattice corner where it is; the first of equals
};

/** By how much a gap may exceed the tolerance after refinement: twice the farthest move and half a voxel's diagonal.
 *  Refinement moves each vertex by `displacement` (mm) and leaves its radius within that half diagonal of the distance
 *  to the nearest boundary vertex, which falls by no more than the move. 0 where nothing was moved. */
double
RefinedGapBound(std::span<const std::array<double, 3>> displacement, const std::array<double, 3> & spacing);

/** Largest gap between a boundary vertex of the shape and the union of the balls of a complex. The same for every
 *  number of threads. \throws Cancelled when the callback says so. */
BoundaryGap
LargestBoundaryGap(const VoxelShape &                     shape,
                   const SpacingWeights &                 weights,
                   std::span<const std::array<double, 3>> positions,
                   std::span<const double>                radius,
                   const ProgressCallback &               progress = {});

} // namespace voxelcore
