#pragma once
// Noise at the boundary of thin parts: a majority that keeps what is curved where it is.

#include "voxelcore/Base/Progress.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Shape/ShapeOperations.h"

namespace voxelcore
{

/** The voxels about which more than half is in, weighed by 3 G - 3 G G + G G G. G is a Gaussian whose standard
 *  deviation is the cube root of a voxel's volume, the same in mm along each axis, and at most 1.3 sides of the
 *  finest. This is twicing (Tukey, Exploratory Data Analysis, 1977) done twice: what is left of G's blur is its third
 *  power, so curved parts neither shrink nor grow to second order, where a plain majority takes half of a rod three
 *  voxels thick. Single wrong voxels go, also a quarter of those at the boundary; farther away from it some may stay.
 *  What is thinner than about two voxels may go, and the topology may change in any way; components are not counted.
 *  In a tight box, that of the shape at most; the same for every number of threads, and turned with the shape.
 *  `spacing`: sides of a voxel. \throws Cancelled when the callback says so. */
EditedShape
DenoiseShape(const VoxelShape & shape, const Vector3 & spacing, const ProgressCallback & progress = {});

} // namespace voxelcore
