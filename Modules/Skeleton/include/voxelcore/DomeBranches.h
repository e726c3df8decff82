#pragma once
// Branches into domes that a line passes through: a body at the side of a tube, wider than its neck, such as a saccular
// aneurysm.

#include "voxelcore/OpenShape.h"
#include "voxelcore/SkeletonGraph.h"

#include <cstddef>

namespace voxelcore
{

/** Of a ball so much must stand out, in its radius, to be a dome. Balls between two tubes of equal radius, whatever
 *  their angle, stand out of theirs by 0.41 of it at most. */
constexpr double kDomeOfRadius = 0.5;

/** Fire in a tube may come to a dome at its side from both ends before it burns the neck: the line runs into the dome
 *  and back. As far as each of the two ways lies in the balls of the other they are one: they meet in the middle
 *  between their last such places, and one branch leads on from there to the dome's greatest ball, when that stands
 *  out of the ball there by `standOut` mm and by kDomeOfRadius. All new segments lie in the shape. Cycles and
 *  components stay what they are. Gives the number of domes. */
std::size_t
BranchIntoDomes(SkeletonGraph & graph, const OpenShape & inside, double standOut);

} // namespace voxelcore
