#pragma once

#include "voxelcore/Lattice/Vectors.h"

namespace voxelcore
{

/** A vector's direction; of none, none. */
inline Vector3
Unit(const Vector3 & a)
{
  const double length = Length(a);
  return length > 0 ? AddScaled({ 0, 0, 0 }, 1 / length, a) : a;
}

} // namespace voxelcore
