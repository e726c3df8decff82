#pragma once
// Vectors of three.

#include "voxelcore/Lattice/ImageGeometry.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace voxelcore
{

inline Vector3
Minus(const Vector3 & a, const Vector3 & b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

/** a + t * b */
inline Vector3
AddScaled(const Vector3 & a, double t, const Vector3 & b)
{
  return { a[0] + t * b[0], a[1] + t * b[1], a[2] + t * b[2] };
}

inline Vector3
Times(const Vector3 & a, const Vector3 & b)
{
  return { a[0] * b[0], a[1] * b[1], a[2] * b[2] };
}

inline Vector3
Over(const Vector3 & a, const Vector3 & b)
{
  return { a[0] / b[0], a[1] / b[1], a[2] / b[2] };
}

inline double
Dot(const Vector3 & a, const Vector3 & b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Vector3
Cross(const Vector3 & a, const Vector3 & b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

inline double
Length(const Vector3 & a)
{
  return std::sqrt(Dot(a, a));
}

inline double
Distance(const Vector3 & a, const Vector3 & b)
{
  return Length(Minus(a, b));
}

/** Between two directions, in degrees; NaN where one has no length. */
inline double
AngleDegrees(const Vector3 & a, const Vector3 & b)
{
  const double lengths = std::sqrt(Dot(a, a)) * std::sqrt(Dot(b, b));
  if (!(lengths > 0))
  {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return std::acos(std::clamp(Dot(a, b) / lengths, -1.0, 1.0)) * (180 / 3.14159265358979323846);
}

} // namespace voxelcore
