#pragma once
// Dilation and erosion by a large ball, by exact squared distances axis by axis (Meijster, Roerdink, Hesselink 2000).
//
// Distances are the lattice's integers, so the places are those of the ball's rows (BallDilation.h), to the last one.
// Time: proportional to the box that the ball has room in, whatever the number of the ball's rows. Memory: a few
// numbers for each place of a slice.

#include "BallDilation.h"

namespace voxelcore
{

/** Whether distances are faster than the ball's rows, one by one, and small enough for their integers. */
bool
DistancesAreFaster(const BallRows & ball, const VoxelBox & box);

/** Dilated(): `dilated` is out, with the shape's box grown by the ball's room. */
void
DilateByDistances(const VoxelShape &       shape,
                  const BallRows &         ball,
                  VoxelShape &             dilated,
                  const ProgressCallback & progress);

/** Puts in each voxel of the shape's box about which the ball lies in what was dilated by it. */
void
ErodeByDistances(const VoxelShape &       dilated,
                 const BallRows &         ball,
                 VoxelShape &             shape,
                 const ProgressCallback & progress);

} // namespace voxelcore
