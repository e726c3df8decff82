#pragma once
// Where a root system has to be cut so that roots which touch are apart: the voxels between them.
//
// A contact is a ball around a meeting of the hierarchy, wide enough that the arms are roots by themselves where they
// leave it. Within, the skeleton of roots that touch runs from one into the other, so each root goes through it on the
// smooth curve between its two arms (Hermite), and roots that would come nearer than three quarters of the sum of their
// radii are moved apart. Each voxel belongs to the root whose curve is nearest in radii of that root. Where a voxel of
// one root has a neighbour across a face in another, and neither springs from the other there, that of the two which is
// farther from its own curve is a wall.

#include "voxelcore/Lattice/ImageGeometry.h"
#include "voxelcore/Roots/RootHierarchy.h"
#include "voxelcore/Shape/VoxelShape.h"

namespace voxelcore
{

/** The walls of all contacts, voxels of the shape, one voxel thick. The skeleton is the shape's, positions are in LPS
 *  mm of `geometry`. Empty without meetings. */
VoxelShape
ContactWalls(const VoxelShape &    shape,
             const ImageGeometry & geometry,
             const SkeletonGraph & graph,
             const RootHierarchy & roots);

} // namespace voxelcore
