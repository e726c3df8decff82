#pragma once
// Where the branches of a curve skeleton end, by the volume of the body around their ends.

#include "voxelcore/Shape/VoxelShape.h"
#include "voxelcore/Skeleton/SkeletonGraph.h"

namespace voxelcore
{

/** Moves the tips of round branches along their axes: to where a tube as thick as the branch before its end, closed by
 *  half a ball around the tip, holds as much as the body does there; the tube may widen or narrow. Where that half ball
 *  lacks what it would have beyond a flat end (TubeEnd.h), the end is flat, and the tip lies half a voxel before its
 *  middle.
 *  Volumes see less of steps and bumps than balls do. A stub too short to be measured is as thick as its balls.
 *  Points within about a radius of it are put on the straight line to the tip, in `medial`, too: the branches are to be
 *  fitted again. Tips stay where the branch is too short, flat or pointed, and where the move is out of proportion or
 *  leads out of the shape.
 *  Of a fitted graph, in LPS mm of the geometry. Gives the number of tips that moved. */
std::size_t
PlaceTips(SkeletonGraph & graph, const VoxelShape & shape, const ImageGeometry & geometry);

} // namespace voxelcore
