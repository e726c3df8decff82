#pragma once
// Branches into domes that a line passes through: a body at the side of a tube, wider than its neck, such as a saccular
// aneurysm.

#include "voxelcore/Skeleton/OpenShape.h"
#include "voxelcore/Skeleton/SkeletonGraph.h"

#include <cstddef>
#include <vector>

namespace voxelcore
{

/** Of a ball so much must stand out, in its radius, to be a dome. Balls between two tubes of equal radius, whatever
 *  their angle, stand out of theirs by 0.41 of it at most. */
constexpr double kDomeOfRadius = 0.5;

/** A branch into a dome ends within so many radii of its greatest ball, and no greater ball lies within as many. A
 *  trunk that ends in two twigs, which are thin beside it, goes on for longer. */
constexpr double kDomeGoesOn = 2;

/** Whether a ball is a dome beside another one whose middle is `way` from its own: greater, and standing out by
 *  kDomeOfRadius. All in mm. */
inline bool
IsDomeBeside(double radius, double other, double way)
{
  return radius > other && way + radius - other >= kDomeOfRadius * radius;
}

/** A branch from a junction that leads into a dome. */
struct DomeBranch
{
  std::size_t  branch = 0;
  ElementIndex node = 0;     ///< the junction
  ElementIndex greatest = 0; ///< point with the dome's greatest ball
};

/** Branches that end in a tip, and whose greatest ball is a dome beside that at their junction and ends with it. In
 *  order of branches. */
std::vector<DomeBranch>
DomesOf(const SkeletonGraph & graph);

/** Fire in a tube may come to a dome at its side from both ends before it burns the neck: the line runs into the dome
 *  and back. As far as each of the two ways lies in the balls of the other they are one: they meet in the middle
 *  between their last such places, and one branch leads on from there to the greatest ball to which balls grow from the
 *  line's greatest on. That ball stands out of the ball there by `standOut` mm and by kDomeOfRadius, and the line's is
 *  the greatest within kDomeGoesOn radii. All new segments lie in the shape. Cycles and components stay what they are.
 *  Gives the number of domes. */
std::size_t
BranchIntoDomes(SkeletonGraph & graph, const OpenShape & inside, double standOut);

/** Draws the line of a tube straight on past each dome at its side. The medial surface bends into the neck there, as
 *  far as the dome has opened the tube's wall: so from where the balls of the tube are apart from the dome's greatest
 *  ball on one side to where they are on the other, the line is the cubic that goes on in its directions there. The
 *  junction lies where that is nearest to the dome's middle, and the dome's branch leads straight there. A dome is a
 *  branch with a tip whose greatest ball stands out of that at its junction by kDomeOfRadius, and which ends with it
 *  (kDomeGoesOn). Where a line would leave
 *  the shape, or a tube ends or forks before it is apart from its dome, it stays. Moves points, in `medial`, too, and
 *  measures their balls anew: the branches are to be fitted again. Gives the number of domes. */
std::size_t
StraightenPastDomes(SkeletonGraph & graph, const OpenShape & inside);

} // namespace voxelcore
