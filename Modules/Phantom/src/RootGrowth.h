#pragma once
// The branches of a root system as they grow: lines with radii, in mm.

#include "Kinds.h"

namespace voxelcore
{

inline Vector3
Sum(const Vector3 & a, const Vector3 & b, double factor = 1)
{
  return { a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2] };
}

inline double
Dot(const Vector3 & a, const Vector3 & b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/** A point of a growing root: position in mm from the grid's corner. */
struct GrownPoint
{
  Vector3      position{};
  double       radius = 0;
  std::int64_t parent = -1;
  std::int32_t branch = 0;
  std::int32_t order = 0;
};

/** Stem, laterals and their laterals. Depends on the sides of the grid and the options alone (and on the spacing where no detail is given).
 *  \throws UsageError when not even the stem fits. */
std::vector<GrownPoint>
GrowRoot(const PhantomOptions & options);

} // namespace voxelcore
