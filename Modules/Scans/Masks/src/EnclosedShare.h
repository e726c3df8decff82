#pragma once
// What lies between the inside and the outside of a shape, shared out.

#include "voxelcore/Base/Progress.h"
#include "voxelcore/Shape/VoxelShape.h"

#include <array>

namespace voxelcore
{

using ClosedSides = std::array<std::array<bool, 2>, 3>;

/** `enclosed` with its share of `between`: each voxel goes to the one of the two regions that it is nearer to by steps
 *  over faces, edges and corners through `between`; as near to both, to the outside. Beyond the box is outside. What is
 *  near neither is enclosed by the shape itself. The three are of one box and have no voxel in common. Beyond the sides
 *  of the box that are `closed` (per axis the lower and the upper one) there is nothing. */
VoxelShape
EnclosedShare(VoxelShape               between,
              VoxelShape               enclosed,
              VoxelShape               outside,
              const ProgressCallback & progress = {},
              const ClosedSides &      closed = {});

} // namespace voxelcore
