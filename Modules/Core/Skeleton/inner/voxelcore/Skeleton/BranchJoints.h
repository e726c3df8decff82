#pragma once
// Where the branches of a curve skeleton meet, by their axes.

#include "voxelcore/Shape/VoxelShape.h"
#include "voxelcore/Skeleton/SkeletonGraph.h"

namespace voxelcore
{

/** Moves junctions at which branches leave another one to where their axes meet that one's, forks to where axes
 *  part.
 *
 *  The medial surface of such a joint lies towards the branch that leaves, and towards the side to which it leans,
 *  where the two bodies come together early: its curve cuts the corner there by up to a radius. So the axes are
 *  taken from where the bodies are apart: that of the branch that leaves, straight on; that of the one that goes
 *  through, as the parabola that fits both its sides. Angles tell which one goes through. A junction stays where
 *  two could go through and it is no fork, and where axes meet at a sharp angle, far away or not at all. Between
 *  yes and no it moves in part.
 *
 *  At a fork two branches turn off a third by about the same angle, and part at less than 70 degrees. At first they
 *  run in one body. On the medial surface their junction depends on where the bodies part, which a single voxel may
 *  change. So it goes to where their axes, drawn on straight, are apart by a part of both radii.
 *
 *  Points within a joint are put on the axes, in `medial`, too: the branches are to be fitted again. `radius` stays
 *  that of the balls there were. No point leaves the shape. Of a fitted graph, in LPS mm of the geometry. Gives the
 *  number of junctions that moved. */
std::size_t
PlaceJoints(SkeletonGraph & graph, const VoxelShape & shape, const ImageGeometry & geometry);

} // namespace voxelcore
