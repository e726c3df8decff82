#pragma once
// Solids whose surfaces and medial axes are known exactly, at any resolution.

#include "voxelcore/ImageGeometry.h"
#include "voxelcore/VoxelShape.h"

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

/** A grid in a generic rotation about a body. */
struct KnownGrid
{
  std::array<Vector3, 3>      axes;
  Vector3                     spacing{ 1, 1, 1 };
  Vector3                     shift{ 0, 0, 0 };
  std::array<std::int32_t, 3> size{ 0, 0, 0 };

  /** From millimetres along the lattice axes to the body, and back. */
  Vector3
  ToBody(const Vector3 & place) const;
  Vector3
  ToGrid(const Vector3 & place) const;
};

KnownGrid
PlaceGrid(const KnownBody & body, const Vector3 & spacing, int rotation);

/** Gauss digitization. */
VoxelShape
Digitize(const KnownBody & body, const KnownGrid & grid);

/** The part of a voxel that is inside, from 6^3 samples. */
double
PartInside(const KnownBody & body, const KnownGrid & grid, const std::array<std::int32_t, 3> & voxel);

} // namespace voxelcore::evaluation
