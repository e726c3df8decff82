#pragma once
// Grids over known bodies, and what scans of these would hold.

#include "RefinementBodies.h"

#include "voxelcore/Shape/VoxelShape.h"

#include <array>
#include <cstdint>

namespace voxelcore::evaluation
{

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
