#pragma once
// A narrower bracket of the local thickness: voxels are cut, and the finer lattice has more vertices on the boundary.
//
// The bracket is as wide as balls through boundary vertices differ from those that meet the boundary's squares, which
// is a matter of a square's sides. A shape whose voxels are cut into smaller boxes is the same shape. With odd numbers
// of parts the centre of a voxel is the centre of its middle part, so that what InscribedBalls.h proves holds of the
// finer lattice as it stands, at the centres of the whole voxels.

#include "voxelcore/Thickness/LocalThickness.h"

#include <array>
#include <cstdint>

namespace voxelcore
{

/** Into how many parts a voxel is cut along each axis: odd, the fewest that leave no side longer than `longest` times
 *  the side of a cube of the voxel's volume. */
std::array<std::int32_t, 3>
FineParts(const SpacingWeights & weights, double longest);

/** The parts that give a bracket whose mean width is below a quarter of a voxel: of cubic voxels 0.07, of others 0.1 to
 *  0.17, as measured. Of shapes of over 250,000 boundary vertices, for which 2 GB would not be enough, only those axes
 *  are cut whose sides are longer than a cube's: cubic voxels stay whole, and the width is 0.25 to 0.3. */
std::array<std::int32_t, 3>
PartsForBounds(const VoxelShape & shape, const SpacingWeights & weights);

/** The most that any shape's voxels are cut into for these. */
std::array<std::int32_t, 3>
PartsForBounds(const SpacingWeights & weights);

/** Each voxel as that many boxes. */
VoxelShape
CutVoxels(const VoxelShape & shape, const std::array<std::int32_t, 3> & parts);

/** The weights of the boxes' lattice. */
SpacingWeights
CutWeights(const SpacingWeights & weights, const std::array<std::int32_t, 3> & parts);

/** Raises the lower and lowers the upper bounds of a bracket by those of the shape cut so. Takes as much time and
 *  memory as a core of the cut shape. The same for every number of threads.
 *  \throws InputError when the numbers would leave the engine's range; Cancelled */
void
TightenBracket(const VoxelShape &                  shape,
               const SpacingWeights &              weights,
               const std::array<std::int32_t, 3> & parts,
               ThicknessBracket &                  bracket,
               const ProgressCallback &            progress = {});

/** Bounds of the local thickness, at voxels' centres, of every smooth surface that the labels allow; without balls and
 *  owners. Such a surface has inside what lies between eight centres of voxels that are in, and outside what lies
 *  between eight that are out. So of the cut boxes those that reach between no other centres lie in all of these
 *  bodies, and all of them in the boxes that reach between any centre that is in; and what lies in another body is
 *  nowhere thicker. The lower bound is 0 where no ball in the inner boxes holds a voxel's centre. Takes up to twice as
 *  much time as TightenBracket(). \throws as that */
ThicknessBracket
SmoothBracket(const VoxelShape & shape, const SpacingWeights & weights, const ProgressCallback & progress = {});

} // namespace voxelcore
