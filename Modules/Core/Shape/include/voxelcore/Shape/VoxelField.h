#pragma once
// Numbers at the voxels of a shape.

#include "voxelcore/Shape/VoxelShape.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace voxelcore
{

/** A number at each voxel of a shape, and nothing elsewhere. */
template <typename T>
struct VoxelField
{
  VoxelBox                   box;            ///< the shape's
  std::vector<std::uint64_t> rowStarts{ 0 }; ///< rows (y fastest) + 1
  std::vector<T>             values;         ///< of the voxels that are in, in scan order

  /** Of the row at box-relative y, z, a value for each of its voxels that is in. */
  std::span<const T>
  Row(std::int32_t y, std::int32_t z) const
  {
    const auto row = static_cast<std::size_t>(z) * static_cast<std::size_t>(box.size[1]) + static_cast<std::size_t>(y);
    return { values.data() + rowStarts[row], values.data() + rowStarts[row + 1] };
  }
};

/** Zero at each voxel of the shape. */
template <typename T>
VoxelField<T>
ZeroAtVoxels(const VoxelShape & shape);

/** Writes the values of the row at box-relative y, z to where its voxels are in a row that begins at the box. */
template <typename T>
void
WriteRow(const VoxelShape & shape, const VoxelField<T> & field, std::int32_t y, std::int32_t z, T * row)
{
  auto       value = field.Row(y, z).begin();
  const auto bits = shape.Row(y, z);
  for (std::size_t word = 0; word < bits.size(); ++word)
  {
    for (std::uint64_t rest = bits[word]; rest != 0; rest &= rest - 1)
    {
      row[64 * word + static_cast<std::size_t>(std::countr_zero(rest))] = *value++;
    }
  }
}

} // namespace voxelcore
