#pragma once
// A balanced kd-tree over lattice points, in the metric of spacing weights or of the spacing itself.

#include "voxelcore/Lattice/LatticePoint.h"
#include "voxelcore/Lattice/SpacingWeights.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace voxelcore
{

/** The tree is the order of the points: the middle of each range splits it. 13 bytes a point, O(n log n) to build.
 *  Points are known by their place in this order. */
class BoundaryTree
{
public:
  /** A point and its squared distance to the query, in units of SpacingWeights::unit squared; with a spacing in
   *  mm^2. */
  struct Candidate
  {
    double        squaredDistance;
    std::uint32_t point;
  };

  /** Up to 2^32 - 2 points. */
  BoundaryTree(std::vector<LatticePoint> points, const SpacingWeights & weights);
  /** Distances are in mm. */
  BoundaryTree(std::vector<LatticePoint> points, const std::array<double, 3> & spacing);

  const std::vector<LatticePoint> &
  Points() const
  {
    return m_Points;
  }

  /** Replaces `found` by all points whose distance to `position` (lattice coordinates) is at most the smallest distance
   *  plus `slack`, by increasing place. Returns the smallest distance; infinity without points. Thread-safe. */
  double
  FindNearest(const std::array<double, 3> & position, double slack, std::vector<Candidate> & found) const;

private:
  struct Search;

  void
  Build(std::size_t first, std::size_t last);
  void
  Descend(Search & search, std::size_t first, std::size_t last, double squaredGap) const;

  std::vector<LatticePoint> m_Points;
  std::vector<std::uint8_t> m_Axes;    ///< of the split at each middle
  std::array<double, 3>     m_Weights; ///< length of a lattice step along each axis
};

} // namespace voxelcore
