#pragma once
// Where a tube ends, by the volume of its body.

#include "BodyAtEnd.h"

#include <optional>

namespace voxelcore
{

/** The half ball that closes a tube. */
struct HalfBall
{
  double height = 0; ///< of its centre
  double radius = 0;
};

/** None where the end is no tube's. The tube below it is measured; that of a stub is as thick as its balls. */
std::optional<HalfBall>
FindHalfBall(const BodyAtEnd & body, const EndLengths & end);

/** How much higher than the centre of a half ball that holds as much the middle of a flat end lies, half a voxel within
 *  the body; 0 where the end is round, and where the tube is too thin to tell. */
double
FlatEndAbove(const BodyAtEnd & body, const EndLengths & end, const HalfBall & cap);

} // namespace voxelcore
