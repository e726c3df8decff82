#pragma once
// Where the branches of a curve skeleton meet, by their axes.

#include "voxelcore/SkeletonGraph.h"
#include "voxelcore/VoxelShape.h"

namespace voxelcore
{

/** Moves junctions at which branches leave another one to where their axes meet that one's, forks to where axes part.
 *
 *  The medial surface of such a joint lies towards the branch that leaves, and towards the side to which it leans,
 *  where the two bodies come together early: its curve cuts the corner there by up to a radius. So the axes are taken
 *  from where the bodies are apart: that of the branch that leaves, straight on; that of the one that goes through, as
 *  the parabola that fits both its sides. Which one goes through, the angles must tell; where two could and it is no
 *  fork, and where axes meet at a sharp angle, far away or not at all, it stays, and between yes and no it moves
 *  in part.
 *
 *  At a fork two branches turn off a third by about as much, and part at an angle of less than 70 degrees. They run in
 *  one body at first; their junction lies where fire from both rims and from where the bodies part meets, which a voxel
 *  may tell. Their axes tell it better: it goes to where these, drawn on straight, are apart by a part of both radii.
 *
 *  Points within a joint are put on the axes, in `medial`, too: the branches are to be fitted again. `radius` stays
 *  that of the balls there were. No point leaves the shape. Of a fitted graph, in LPS mm of the geometry. Gives the
 *  number of junctions that moved. */
std::size_t
PlaceJoints(SkeletonGraph & graph, const VoxelShape & shape, const ImageGeometry & geometry);

} // namespace voxelcore
