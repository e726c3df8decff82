#pragma once
// The boundary vertices nearest to each vertex of a complex.

#include "ExactCentre.h"
#include "voxelcore/Complex/CellComplex.h"
#include "voxelcore/Verification/BoundaryTree.h"

#include <functional>
#include <span>
#include <vector>

namespace voxelcore::verification
{

/** Points are places in the tree; sets are increasing. A vertex that is not the centre of an empty sphere through four
 *  affinely independent points has an empty set and no basis. */
struct NearestSets
{
  std::vector<std::uint64_t>                offsets{ 0 };
  std::vector<std::uint32_t>                points;
  std::vector<std::array<std::uint32_t, 4>> basis;    ///< four affinely independent points of the set
  std::vector<double>                       distance; ///< to the nearest boundary vertices, in units of weights.unit

  std::span<const std::uint32_t>
  Of(std::size_t vertex) const
  {
    return { points.data() + offsets[vertex], points.data() + offsets[vertex + 1] };
  }
  bool
  IsKnown(std::size_t vertex) const
  {
    return offsets[vertex] != offsets[vertex + 1];
  }
};

/** Finds, for each position, the points whose distance is smallest within what the tolerance (lattice units) allows,
 *  and among them, exactly, the cospherical set whose centre the position is. A tolerance so coarse that more than 64
 *  points come into question without all being cospherical leaves a set unknown.
 *  `progress` is told the fraction done, now and then, and may throw. */
NearestSets
FindNearestSets(const BoundaryTree &                   tree,
                const SpacingWeights &                 weights,
                std::span<const std::array<double, 3>> positions,
                double                                 tolerance,
                const std::function<void(double)> &    progress = {});

/** The exact centre of a vertex whose set is known. */
ExactCentre
CentreOf(const NearestSets & sets, const BoundaryTree & tree, const SpacingWeights & weights, std::size_t vertex);

/** What two increasing ranges share. `common` may not be one of them. */
void
Intersect(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b, std::vector<std::uint32_t> & common);

} // namespace voxelcore::verification
