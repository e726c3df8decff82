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

/** Puts the arm whose branch forks to the front and says where the axes of the other two part. Their `from` becomes
 *  where their bodies are apart. Nothing for other than three arms.
 *
 *  Where bodies part a voxel may tell, and with it where fire on the surface between them meets. So the place is told
 *  by axes fitted behind that and drawn on straight: they are apart there by the sum of radii times 1 - 1.5 T, T being
 *  the tangent of half their angle. Fire meets at 1 - T, measured at forks of 20 to 60 degrees; but the arms go
 *  straight from the place to their axes, which is shorter, and so much nearer to the stem lengths are as they
 *  were. */
std::optional<ForkPlace>
PlaceFork(std::vector<Arm> & arms, double voxel);

} // namespace voxelcore
