#pragma once
// Where the branches of a curve skeleton meet, by their axes.

#include "voxelcore/SkeletonGraph.h"
#include "voxelcore/VoxelShape.h"

namespace voxelcore
{

/** Moves junctions at which branches leave another one to where their axes meet that one's.
 *
 *  The medial surface of such a joint lies towards the branch that leaves, and towards the side to which it leans,
 *  where the two bodies come together early: its curve cuts the corner there by up to a radius. So the axes are taken
 *  from where the bodies are apart: that of the branch that leaves, straight on; that of the one that goes through, as
 *  the parabola that fits both its sides. Which one goes through, the angles must tell; where two could, as in forks,
 *  and where axes meet at a sharp angle, far away or not at all, a junction stays, and between yes and no it moves in
 *  part.
 *
 *  Points within a joint are put on the axes, in `medial`, too: the branches are to be fitted again. `radius` stays
 *  that of the balls there were. No point leaves the shape. Of a fitted graph, in LPS mm of the geometry. Gives the
 *  number of junctions that moved. */
std::size_t
PlaceJoints(SkeletonGraph & graph, const VoxelShape & shape, const ImageGeometry & geometry);

} // namespace voxelcore
