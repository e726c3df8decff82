#pragma once
// Balls inscribed in the smooth surface that a shape's voxels stand for: local thickness by its definition (Hildebrand,
// Rueegsegger 1997), of that surface instead of the voxels'.
//
// The surface is known at places, one for each square of the boundary: from the labels alone (SurfacePlaces.h), or
// where an estimate from grey values or a mesh has it. At each place the greatest ball is found that touches it from
// within and has no other place in it: a ball is shrunk until it touches the one place that it may not hold (Ma, Bae,
// Choi 2012). As between places it might bulge out, and as single places err, its radius is the mean distance, along
// their normals, of the surface at all places that it nearly touches. On a plane, along a tube and all around a ball
// these distances are the same, so that it makes no difference how many places there are.
//
// How far around a square the labels are fitted follows the thickness: what is thin must not be mixed with what is
// near it, and what is thick needs more squares, as the least of many places that err is too small. So the map is made
// twice: first with one reach for all, whose map tells reaches.
//
// Whatever the places say, no ball reaches by more than half a part (FineBracket.h) into what lies between eight
// centres of voxels that are out: no surface that the labels allow has that inside. So no map of these balls is above
// the upper bound of SmoothBracket().

#include "voxelcore/Refinement/SurfaceEstimate.h"
#include "voxelcore/Thickness/LocalThickness.h"

namespace voxelcore
{

/** The balls, in no order that means anything; about places in lattice coordinates within the shape's voxels. Of
 *  labels, where there is no `surface`. The same for every number of threads, and near any voxel the same bits for any
 *  shape that is the same within four radii of the greatest ball and kSmoothReach of it. \throws Cancelled */
PaintingBalls
SmoothBalls(const VoxelShape &       shape,
            const SpacingWeights &   weights,
            const SurfaceEstimate *  surface = nullptr,
            const ProgressCallback & progress = {});

/** In longest sides of a voxel: beyond balls, labels are looked at so far around a voxel to tell its thickness. */
inline constexpr double kSmoothReach = 16;

/** Local thickness of the smooth surface, mm, by the balls that voxels belong to (OwnersAmong()). A voxel that its ball
 *  does not hold has that ball's thickness where the labels allow one so great to hold it, or else as much of it as
 *  they allow, by steps of a sixteenth. */
VoxelValues
SmoothThicknessOf(const VoxelShape &     shape,
                  const SpacingWeights & weights,
                  const PaintingBalls &  balls,
                  const VoxelOwners &    owners);

/** By how much a ball may be greater than its centre is far from the voxels' boundary, mm: half a voxel's diagonal that
 *  a place may lie off its square's middle, half a square's diagonal from there, and what a ball nearly touches. */
double
MostBeyondVoxels(const SpacingWeights & weights);

/** Whether no ball is greater than that, the distance being measured anew to the squares themselves. */
bool
LieInVoxels(const PaintingBalls & balls, const VoxelShape & shape, const SpacingWeights & weights);

} // namespace voxelcore
