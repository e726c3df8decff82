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

/** How far a boundary vertex may lie from the balls of a core that was pruned by tolerance, mm. */
struct PromisedGap
{
  double weighed = 0; ///< LargestWeighedGap() must not exceed this
  double beyond = 0;  ///< that much of each gap is not weighed, but allowed everywhere
};

/** Of a core that was pruned by tolerance `height` and refined: the height, but no less than half a voxel's diagonal,
 *  within which the smooth surface, that refined balls touch, lies from the boundary vertices. With moves in mm, of a
 *  core pruned on to `height` after it was refined: nobody looked then, so it is the height, and beyond it twice the
 *  farthest move and half a diagonal, as radii are within that half of the distance of the nearest boundary vertex,
 *  which falls by no more than the move. */
PromisedGap
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

/** The same of what is beyond `beyond` mm of each gap, times the diagonal of a voxel over what the boundary is
 *  uncertain by there: the voxel's extent along the boundary's normal n, sum of |n_i| s_i with the sides s, but no less
 *  than sqrt(3) times the least side. For cubes all that is 1.
 *
 *  The normal is the gradient of the mask smoothed over about the thickness of a slice: along each axis twice by a run
 *  of w_i voxels, w_i the least whole number from 1 to 32 with (2 w_i + 1)^2 >= 6 q^2 - 2, or 32, where q is the
 *  largest side over s_i; then the difference of the two voxels at the corner along an axis, summed over those along
 *  the others. Where that is 0 nothing is weighed. */
BoundaryGap
LargestWeighedGap(const VoxelShape &                     shape,
                  const SpacingWeights &                 weights,
                  std::span<const std::array<double, 3>> positions,
                  std::span<const double>                radius,
                  double                                 beyond = 0,
                  const ProgressCallback &               progress = {});

/** LargestBoundaryGap() and LargestWeighedGap(); for cubes one search finds both. */
struct BoundaryGaps
{
  BoundaryGap plain;
  BoundaryGap weighed;
};

BoundaryGaps
LargestBoundaryGaps(const VoxelShape &                     shape,
                    const SpacingWeights &                 weights,
                    std::span<const std::array<double, 3>> positions,
                    std::span<const double>                radius,
                    double                                 beyond = 0);

} // namespace voxelcore
