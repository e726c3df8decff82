#pragma once
// Vectors of three.

#include "voxelcore/ImageGeometry.h"

#include <cmath>

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

} // namespace voxelcore
