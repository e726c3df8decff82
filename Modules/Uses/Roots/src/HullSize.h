#pragma once
// How large the convex hull of points in space is, and how wide they lie.

#include "voxelcore/Lattice/Vectors.h"

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

/** The greatest distance between places across a direction of length 1, up to a thousandth: seen from 180 sides. */
double
WidthAcross(const Vector3 & direction, const std::vector<Vector3> & places);

} // namespace voxelcore
