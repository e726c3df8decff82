#pragma once
// Triangles in space, as a mesh file has them.

#include "voxelcore/Lattice/ImageGeometry.h"

#include <array>
#include <cstdint>
#include <vector>

namespace voxelcore
{

/** Corners are indices of points; seen from outside they run counter-clockwise. Points may be there several times. */
struct TriangleMesh
{
  std::vector<Vector3>                      points; ///< LPS mm, finite
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

} // namespace voxelcore
