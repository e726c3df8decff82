#pragma once
// Torn roots in a shape: thin pieces that noise or thick slices have cut off are joined again, along their own way.

#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Shape/VoxelShape.h"

#include <cstdint>

namespace voxelcore
{

/** A shape with its torn pieces joined. */
struct TornPieces
{
  VoxelShape    shape;
  std::uint64_t voxelsAdded = 0;
  std::uint64_t piecesJoined = 0; ///< by how many components there are fewer
};

/** Joins components (6-connected) over gaps that lie in their own way.
 *
 *  A component is torn off if it has 8 voxels or more and is twice as long as thick: long from the voxel farthest from
 *  its centre to the one farthest from that, as thick as a rod with its volume. From each of these ends the nearest
 *  voxel of another such component, or of the largest, within 60 degrees of the way the piece takes at this end is
 *  looked for, up to `gap` of its diameters and a voxel away; what lies aside counts as farther, by 1 / cos. The two
 *  are joined by a line of voxels over faces; nearer ones first, and none that hang together already. Smaller
 *  components stay as they are.
 *
 *  `spacing` and distances in mm. The box stays. */
TornPieces
JoinTornPieces(VoxelShape shape, const Vector3 & spacing, double gap);

} // namespace voxelcore
