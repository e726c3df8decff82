#include "voxelcore/Shape/VoxelField.h"

#include "voxelcore/Base/CountBits.h"

namespace voxelcore
{

template <typename T>
VoxelField<T>
ZeroAtVoxels(const VoxelShape & shape)
{
  VoxelField<T> map;
  const auto &  size = shape.Box().size;
  std::uint64_t count = 0;
  map.box = shape.Box();
  map.rowStarts.reserve(static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(size[2]) + 1);
  for (std::int32_t z = 0; z < size[2]; ++z)
  {
    for (std::int32_t y = 0; y < size[1]; ++y)
    {
      for (const std::uint64_t word : shape.Row(y, z))
      {
        count += CountBits(word);
      }
      map.rowStarts.push_back(count);
    }
  }
  map.values.assign(count, T{ 0 });
  return map;
}

template VoxelField<float>
ZeroAtVoxels(const VoxelShape & shape);
template VoxelField<std::uint32_t>
ZeroAtVoxels(const VoxelShape & shape);

} // namespace voxelcore
