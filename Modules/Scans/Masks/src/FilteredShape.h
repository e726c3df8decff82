#pragma once
// What a filter of voxels has changed.

#include "voxelcore/Base/CountBits.h"
#include "voxelcore/Shape/ShapeOperations.h"

#include <utility>

namespace voxelcore
{

/** `after`, which lies in the box of `before`, in a tight box, with the voxels that it has more and less. */
inline EditedShape
FilteredShape(const VoxelShape & before, VoxelShape after)
{
  EditedShape edited{ std::move(after) };
  const auto  size = before.Box().size;
  for (std::int32_t z = 0; z < size[2]; ++z)
  {
    for (std::int32_t y = 0; y < size[1]; ++y)
    {
      const auto from = before.Row(y, z);
      const auto to = std::as_const(edited.shape).Row(y, z);
      for (std::size_t word = 0; word < from.size(); ++word)
      {
        edited.voxelsAdded += CountBits(to[word] & ~from[word]);
        edited.voxelsRemoved += CountBits(from[word] & ~to[word]);
      }
    }
  }
  edited.shape = CropToVoxels(std::move(edited.shape));
  return edited;
}

} // namespace voxelcore
