#pragma once
// What labels leave open of a wall's thickness.

#include "voxelcore/Lattice/ImageGeometry.h"
#include "voxelcore/Shape/VoxelShape.h"
#include "voxelcore/VoxelCore/MedialComplex.h"

#include <vector>

namespace voxelcore
{

/** By how much a wall's half thickness may be off its radius, per vertex, mm.
 *
 *  A plane that parts the voxels in from those out may be shifted until it meets the centre of one of them: along the
 *  grid by a whole voxel, along other planes of the lattice by the distance of its planes, obliquely hardly at all.
 *  Each of a wall's sides, a radius from the vertex across its sheet, may lie as far in and out as the voxels let the
 *  plane there, within a few voxels' reach. A wall whose sides lie along the sheet has its true half thickness within
 *  the margin of the radius.
 *
 *  Curves have no sides: 0 there, as where the voxels about a side fit no plane and so tell where it lies; vertices in
 *  which sheets of different directions meet have the greatest margin of their sheets' next ones.
 *  Positions of `core` in lattice coordinates, radii and `spacing` in mm. The same bits for every number of threads. */
std::vector<double>
RadiusMargins(const MedialComplex & core, const VoxelShape & shape, const Vector3 & spacing);

} // namespace voxelcore
