#pragma once
// Volumes that several labels share, and names of files beside an output.

#include "voxelcore/Lattice/ImageGeometry.h"
#include "voxelcore/Shape/VoxelField.h"
#include "voxelcore/Shape/VoxelShape.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace voxelcore
{

/** "OUT_columns.json" for "OUT.csv". */
std::filesystem::path
ColumnsBeside(const std::filesystem::path & table);

/** A volume that several labels share. */
template <typename T>
struct VolumeOfLabels
{
  std::vector<const VoxelShape *>    shapes;
  std::vector<const VoxelField<T> *> values;
};

/** The values of slice k, which is all zero. */
template <typename T>
void
FillSlice(const VolumeOfLabels<T> & volume, const ImageGeometry & geometry, std::int64_t k, std::span<T> slice)
{
  for (std::size_t i = 0; i < volume.shapes.size(); ++i)
  {
    const VoxelShape & shape = *volume.shapes[i];
    const auto &       box = shape.Box();
    const auto         z = static_cast<std::int32_t>(k - box.lower[2]);
    if (z < 0 || z >= box.size[2])
    {
      continue;
    }
    for (std::int32_t y = 0; y < box.size[1]; ++y)
    {
      T * const to = slice.data() + (y + box.lower[1]) * geometry.size[0] + box.lower[0];
      WriteRow(shape, *volume.values[i], y, z, to);
    }
  }
}

} // namespace voxelcore
