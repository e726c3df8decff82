#pragma once
// Sheets that stay keep their rims.

#include "CoreBall.h"
#include "ToleranceLevels.h"

#include "voxelcore/VoxelCore/MedialComplex.h"

#include <vector>

namespace voxelcore
{

/** Raises tolerances, as far as they are measured (ToleranceLevels::Measured()), so that up to there a sheet that stays
 *  keeps its rims, and one that goes keeps them up to three quarters of the height at which it is gone.
 *
 *  Fire enters sheets at their rims. At a height h it has taken a strip from each that stands for no bump: of a flat
 *  one it is nearly h wide, and wider where the radius falls towards the rim. Here such strips get the height of the
 *  last face of their sheet, or three quarters of it where that is measured. A sheet is made of faces above the
 *  staircase of the voxels (0.8 of a voxel's diagonal) whose nearest boundary points lie wide apart: measure at least
 *  0.643 of the radius, 80 degrees as the centre of the ball sees them. It goes on across edges where it bends by 35
 *  degrees at most: a plate's sheet ends where its corners begin. Faces with less than half of their edges' length
 *  within what is raised are teeth of its rim and stay as they are.
 *
 *  What lies between the staircase and the end of the measured heights is then collapsed anew by the raised heights,
 *  simple pairs only. All of it goes by that end, as it did before: in complexes of faces a pair that is simple stays
 *  so until one of the two goes. So topology and nesting hold. No height falls: at each more is left, and coverage
 *  holds, too. */
void
KeepSheetsWhole(const MedialComplex &         core,
                const std::vector<CoreBall> & balls,
                const ToleranceLevels &       levels,
                ToleranceValues &             values);

} // namespace voxelcore
