#pragma once
// Solids whose surfaces and medial axes are known exactly, at any resolution.

#include "voxelcore/Lattice/ImageGeometry.h"

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace voxelcore::evaluation
{

/** Triangles; degenerate ones stand for segments. */
struct TriangleSet
{
  std::vector<Vector3>                      vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/** About the origin; lengths in millimetres. */
struct KnownBody
{
  std::string                            name;
  std::function<double(const Vector3 &)> value;   ///< negative inside; its magnitude is never more than the distance
  TriangleSet                            surface; ///< curved parts to within 1e-4 of the size
  TriangleSet                            axis;
  TriangleSet                            pruned; ///< the part of the axis whose radius measure is lambda or more
  double                                 reach = 0;
};

/** Ellipsoid, torus, capsule, rounded slab, sharp box, Y of sheets, about `size` long. */
std::vector<KnownBody>
KnownBodies(double size, double lambda);

} // namespace voxelcore::evaluation
