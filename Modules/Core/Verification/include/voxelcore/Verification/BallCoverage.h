#pragma once
// How well the balls of a medial surface rebuild the boundary they came from: what pruning by tolerance promises,
// measured with nothing of what made them.

#include "voxelcore/Base/Progress.h"
#include "voxelcore/Lattice/SpacingWeights.h"
#include "voxelcore/Shape/VoxelShape.h"

#include <array>
#include <cstdint>
#include <span>

namespace voxelcore
{

/** The boundary vertex that lies farthest from the balls. */
struct BoundaryGap
{
  double                      largest = 0; ///< mm; infinity without balls, 0 for an empty shape
  std::array<std::int32_t, 3> place{};     ///< lattice corner where it is; the first of equals
};

/** How far a boundary vertex may lie from the balls of a core that was pruned by tolerance `height` and refined, mm:
 *  the height, but no less than half a voxel's diagonal, within which the smooth surface, that refined balls touch,
 *  lies from the boundary vertices. With moves in mm, of a core pruned on to `height` after it was refined: nobody
 *  looked then, so it is the height, twice the farthest move and half a diagonal, as radii are within that half of the
 *  distance of the nearest boundary vertex, which falls by no more than the move. */
double
RefinedGapBound(double                                 height,
                const std::array<double, 3> &          spacing,
                std::span<const std::array<double, 3>> movesBeforePruning = {});

/** Largest gap between a boundary vertex of the shape and the union of the balls of a complex. The same for every
 *  number of threads. \throws Cancelled when the callback says so. */
BoundaryGap
LargestBoundaryGap(const VoxelShape &                     shape,
                   const SpacingWeights &                 weights,
                   std::span<const std::array<double, 3>> positions,
                   std::span<const double>                radius,
                   const ProgressCallback &               progress = {});

} // namespace voxelcore
