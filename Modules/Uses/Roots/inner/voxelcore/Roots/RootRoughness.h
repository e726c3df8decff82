#pragma once
// How rough roots are, and what stands out of them no more than that.

#include "voxelcore/Lattice/ImageGeometry.h"
#include "voxelcore/Roots/RootHierarchy.h"
#include "voxelcore/Shape/VoxelShape.h"

namespace voxelcore
{

/** Per point of the graph the roughness of the root it is on, mm; a parent's where a lateral springs. Each boundary
 *  voxel of the shape belongs to the root whose ball is nearest; the roughness of a root is the scatter of their
 *  distances from these balls: 1.48 times the median deviation from the median, which is the standard deviation where
 *  they are normal, and which what grows on less than half of a root does not change. Steps of voxels make 0.3 of
 *  one, up to 0.7 along the grid. Positions are in LPS mm of `geometry`. */
std::vector<double>
RootRoughness(const VoxelShape &    shape,
              const ImageGeometry & geometry,
              const SkeletonGraph & graph,
              const RootHierarchy & roots);

/** Takes off branches with a tip that stand out by less than RootRules::bulge times the roughness of the root they
 *  spring from (PruneBulges(), SkeletonGraph.h); gives what was left out. Before torn roots are joined: a bulge is no
 *  end of one. */
RootBulges
LeaveOutBulges(const VoxelShape &    shape,
               const ImageGeometry & geometry,
               const RootRules &     rules,
               SkeletonGraph &       graph);

} // namespace voxelcore
