#pragma once
// Where a tube ends, by the volume of its body.

#include "BodyAtEnd.h"

#include <optional>

namespace voxelcore
{

/** The height of the centre of the half ball; none where the end is no tube's. The tube below it is measured; that of a
 *  stub is as thick as its balls. */
std::optional<double>
HeightOfHalfBall(const BodyAtEnd & body, const EndLengths & end);

} // namespace voxelcore
