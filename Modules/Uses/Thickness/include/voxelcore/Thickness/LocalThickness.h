#pragma once
// Local thickness: at each voxel the diameter of the largest ball that holds its centre (Hildebrand, Rueegsegger 1997).

#include "voxelcore/Shape/VoxelField.h"
#include "voxelcore/Shape/VoxelShape.h"
#include "voxelcore/Thickness/InscribedBalls.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace voxelcore
{

using VoxelValues = VoxelField<float>;

/** At each voxel, 1 + the index of the ball that gives it its thickness; 0: none does. */
using VoxelOwners = VoxelField<std::uint32_t>;

/** Gives each voxel that still has zero twice the greatest value of the balls that hold its centre, in mm. A ball is
 *  taken as closed and by 1e-10 of its radius greater, so that rounding puts no centre on its sphere out of it.
 *  Rows of voxels are painted from the greatest value down, each voxel once. Time: rows of balls and voxels.
 *  The same for every number of threads. \throws Cancelled */
void
PaintThickness(const VoxelShape &       shape,
               const SpacingWeights &   weights,
               const PaintingBalls &    balls,
               VoxelValues &            map,
               const ProgressCallback & progress = {});

/** The same, but of the balls themselves: at each voxel the one of greatest value, of equal ones the first. */
void
PaintOwners(const VoxelShape &       shape,
            const SpacingWeights &   weights,
            const PaintingBalls &    balls,
            VoxelOwners &            owners,
            const ProgressCallback & progress = {});

/** The thickness that each voxel's owner gives it, mm; 0 where there is none. */
VoxelValues
DiametersOfOwners(const PaintingBalls & balls, const VoxelOwners & owners);

/** Gives each voxel that still has zero the diameter of the largest inscribed ball about its centre. `around`: the
 *  shape that the balls lie in, where the map is of a part of its voxels, `shape`. */
void
FillWithOwnBalls(const VoxelShape &     shape,
                 const SpacingWeights & weights,
                 VoxelValues &          map,
                 const VoxelShape *     around = nullptr);

/** A truly inscribed ball of the first diameter holds the centre of a voxel, none of more than the second does. */
struct ThicknessBracket
{
  VoxelValues lower; ///< mm
  VoxelValues upper; ///< mm; empty where it was not asked for

  PaintingBalls balls;     ///< those that the lower bounds are of
  VoxelOwners   owners;    ///< among them; 0: the voxel has the ball about its own centre
  double        reach = 0; ///< no centre of a ball is farther from the nearest boundary vertex, mm
};

/** Drops the balls that no voxel is of. */
void
KeepOwners(PaintingBalls & balls, VoxelOwners & owners);

/** The local thickness of a shape from its Delaunay cells (InscribedBalls.h), or at a part of its voxels, `part`. The
 *  same for every number of threads. \throws Cancelled */
ThicknessBracket
BracketThickness(const VoxelShape &            shape,
                 std::span<const LatticePoint> points,
                 const DelaunayCells &         cells,
                 const SpacingWeights &        weights,
                 bool                          upper,
                 const ProgressCallback &      progress = {},
                 const VoxelShape *            part = nullptr);

} // namespace voxelcore
