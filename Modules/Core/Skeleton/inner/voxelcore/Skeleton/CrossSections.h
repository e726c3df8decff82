#pragma once
// How wide the body is around its skeleton.

#include "voxelcore/Lattice/ImageGeometry.h"
#include "voxelcore/Shape/VoxelShape.h"
#include "voxelcore/Skeleton/SkeletonGraph.h"

#include <vector>

namespace voxelcore
{

/** At each point of a skeleton the radius of the round tube whose cross-section has the area of the body's, in mm.
 *
 *  Each face of a voxel on the boundary belongs to the nearest point of the branch it lies nearest to, seen from the
 *  branch's largest balls. By the divergence theorem half the integral of (x - c) n across the branch over a stretch's
 *  faces is its volume, and volume over length is an area: at each point that of the parabola along the branch which
 *  fits best over two extents of a voxel before and behind it, so that stenoses and bulges keep their depth. A digital
 *  tube has the radius of the tube it was made of, however thin it is and wherever it points, while the ball that fits
 *  between its corners is up to a voxel smaller or larger. For a cross-section that is not round this is the geometric
 *  mean of its half axes, say, where the ball's radius is the least of them.
 *
 *  Beyond a tip the branch is taken to go on straight as far as the body does. Within the balls at junctions, and where
 *  a tube opens into a dome at its side, it is the ball's radius plus what its next neighbour on the branch has more
 *  than its ball. A component without a cross-section has the radius of the round rod of its length with its
 *  volume. Points of faces that stay keep the ball's radius.
 *
 *  `shape` is the body the skeleton is of, in the voxels of `geometry`; positions of the graph are in its LPS mm. The
 *  same bits for every number of threads. */
std::vector<double>
CrossSectionRadii(const SkeletonGraph & graph, const VoxelShape & shape, const ImageGeometry & geometry);

} // namespace voxelcore
