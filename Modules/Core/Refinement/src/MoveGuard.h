#pragma once
// Keeps moves within what a refined core promises.

#include "voxelcore/Refinement/Refinement.h"

namespace voxelcore
{

/** Shortens a displacement (lattice coordinates) until it is at most a voxel long and ends in the open shape. */
Vector3
KeepInShape(const VoxelShape & shape, const Vector3 & place, const Vector3 & displacement);

/** Evens out and then shortens displacements that hold to KeepInShape(), until no triangle of `cells` turns over: its
 *  normals before and after, in mm along the lattice axes, must enclose less than 90 degrees. They hold to it still. */
void
GuardMoves(const VoxelShape &           shape,
           const CellComplex &          cells,
           const std::vector<Vector3> & positions,
           const Vector3 &              spacing,
           std::vector<Vector3> &       displacement);

} // namespace voxelcore
