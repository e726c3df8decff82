#pragma once
// The axis along which points lie farthest apart.

#include "voxelcore/Lattice/ImageGeometry.h"

#include <array>

namespace voxelcore
{

/** Eigenvector to the greatest eigenvalue of a symmetric matrix, by Jacobi's rotations; `greatest` gets the value. */
Vector3
GreatestAxis(std::array<Vector3, 3> m, double & greatest);

} // namespace voxelcore
