#pragma once
// Facets on the boundary that are not asked for: DelaunayCells::voxelSides.

#include "voxelcore/Delaunay/DelaunayCells.h"

namespace voxelcore
{

inline bool
AreAlike(const SpacingWeights & weights)
{
  return weights.weight[0] == weights.weight[1] && weights.weight[1] == weights.weight[2];
}

/** The bit that notes a side across an axis. */
inline std::uint8_t
VoxelSide(std::size_t axis, const SpacingWeights & weights)
{
  return static_cast<std::uint8_t>(1U << (AreAlike(weights) ? 0 : axis));
}

/** The axis across a voxel's side, by two opposite corners of it. */
inline std::size_t
AxisAcross(const LatticePoint & corner, const LatticePoint & opposite)
{
  return corner.x == opposite.x ? 0 : corner.y == opposite.y ? 1 : 2;
}

/** Notes the facets on the boundary in voxelSides, which may have some already, and leaves them without a cell.
 *  \throws CertificateError where one is no side of a voxel */
void
NoteBoundary(const std::vector<LatticePoint> & points, const SpacingWeights & weights, DelaunayCells & cells);

} // namespace voxelcore
