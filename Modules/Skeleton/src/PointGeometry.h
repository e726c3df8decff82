#pragma once
// Vectors of three.

#include <array>
#include <cmath>

namespace voxelcore
{

using Point3 = std::array<double, 3>;

inline Point3
Minus(const Point3 & a, const Point3 & b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

inline double
Dot(const Point3 & a, const Point3 & b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline double
Distance(const Point3 & a, const Point3 & b)
{
  const Point3 d = Minus(b, a);
  return std::sqrt(Dot(d, d));
}

} // namespace voxelcore
