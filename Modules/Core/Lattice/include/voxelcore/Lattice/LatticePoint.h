#pragma once
// Integer points of the box lattice whose cells are the voxels.

#include <compare>
#include <cstdint>

namespace voxelcore
{

/** A corner of voxels. Corner (0,0,0) lies at the continuous voxel index (-1/2,-1/2,-1/2), so voxel (i,j,k) has the
 *  corners (i,j,k) to (i+1,j+1,k+1). Ordered lexicographically by x, then y, then z. */
struct LatticePoint
{
  std::int32_t x;
  std::int32_t y;
  std::int32_t z;

  friend auto
  operator<=>(const LatticePoint &, const LatticePoint &) = default;
};

} // namespace voxelcore
