#pragma once
// Places in the border of a scan.

#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Shape/VoxelShape.h"

namespace voxelcore
{

/** Whether a place in lattice coordinates lies in the border of a scan, or beyond it. */
inline bool
IsAtBorder(const VoxelBox & scan, const Vector3 & lattice)
{
  constexpr double kNear = 0.5; // of a voxel: as far as a surface is from the boundary of voxels
  for (std::size_t k = 0; k < 3; ++k)
  {
    if (lattice[k] < scan.lower[k] + kNear || lattice[k] > scan.lower[k] + scan.size[k] - kNear)
    {
      return true;
    }
  }
  return false;
}

} // namespace voxelcore
