#pragma once
// The part of a plane that lies in a body: its outline and what that measures.

#include "PlaneSides.h"

#include <cstdint>
#include <vector>

namespace voxelcore
{

/** Closed lines around the connected part of a plane in the body that holds the plane's origin, or what of the body is
 *  nearest to it, up to `astray` squares away. Points in sides of squares; the body lies on the left. None where the
 *  plane has nothing of the body there. */
std::vector<std::vector<Vector2>>
PlaneContours(PlaneSides & sides, std::int32_t astray);

/** What is within closed lines. */
struct OutlineNumbers
{
  double  area = 0;
  double  perimeter = 0;
  Vector2 centre{};
  double  leastWidth = 0; ///< of the convex hull
  Vector2 leastWay{};
  double  greatestWidth = 0;
  Vector2 greatestWay{};
};

OutlineNumbers
MeasureOutline(const std::vector<std::vector<Vector2>> & lines);

} // namespace voxelcore
