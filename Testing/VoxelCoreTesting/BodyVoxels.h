#pragma once
// Voxels of bodies that are told by a function.

#include "voxelcore/Lattice/ImageGeometry.h"
#include "voxelcore/Shape/VoxelShape.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace voxelcore::testing
{

/** Voxels whose middle lies in a body of so many mm to each side of the origin, which is anywhere in a voxel. */
template <typename IsIn>
VoxelShape
VoxelsAround(const Vector3 & half, const Vector3 & spacing, const Vector3 & shift, const IsIn & isIn)
{
  std::array<std::int32_t, 3> size{};
  Vector3                     origin{};
  for (std::size_t k = 0; k < 3; ++k)
  {
    size[k] = static_cast<std::int32_t>(std::ceil(2 * half[k] / spacing[k])) + 3;
    origin[k] = (0.5 * size[k] + shift[k]) * spacing[k];
  }
  VoxelShape shape(VoxelBox{ { 0, 0, 0 }, size });
  for (std::int32_t z = 0; z < size[2]; ++z)
  {
    for (std::int32_t y = 0; y < size[1]; ++y)
    {
      for (std::int32_t x = 0; x < size[0]; ++x)
      {
        if (isIn(Vector3{ (x + 0.5) * spacing[0] - origin[0],
                          (y + 0.5) * spacing[1] - origin[1],
                          (z + 0.5) * spacing[2] - origin[2] }))
        {
          shape.Insert(x, y, z);
        }
      }
    }
  }
  return CropToVoxels(std::move(shape));
}

} // namespace voxelcore::testing
