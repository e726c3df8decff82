#pragma once
// Where two branches that fork leave each other, by their axes.

#include "JointAxes.h"

#include <optional>
#include <vector>

namespace voxelcore
{

/** The place of a fork. */
struct ForkPlace
{
  Vector3 place{};
  double  isSo = 0; ///< from 0 to 1: whether the arms fork
};

/** Puts the stem, the arm that forks, to the front and finds where the axes of the other two part. Their `from` becomes
 *  where their bodies are apart. Nothing if there are not three arms.
 *
 *  A single voxel may change where two bodies part, and where fire on the surface between them meets. So axes are
 *  fitted beyond that and drawn on straight. The fork is where they are apart by the sum of radii times 1 - 1.5 T; T is
 *  the tangent of half their angle. Fire meets where they are apart by 1 - T (measured at forks of 20 to 60 degrees).
 *  But arms go straight from the fork to their axes, which is shorter. The factor of 1.5 makes up for that, so that
 *  lengths stay as they were. */
std::optional<ForkPlace>
PlaceFork(std::vector<Arm> & arms, double voxel);

} // namespace voxelcore
