#pragma once
// How large the convex hull of points in space is.

#include "voxelcore/Vectors.h"

#include <vector>

namespace voxelcore
{

struct HullSize
{
  double volume = 0;
  double surface = 0; ///< both 0 where all points lie in a plane
};

HullSize
ConvexHullSize(const std::vector<Vector3> & points);

} // namespace voxelcore
