#include "voxelcore/Shape/PaddedShape.h"

namespace voxelcore
{

PaddedShape::PaddedShape(const VoxelShape & shape)
{
  VoxelBox box = shape.Box();
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    box.lower[axis] -= kRoom;
    box.size[axis] += 2 * kRoom;
  }
  m_Shape = VoxelShape(box);
  for (std::int32_t z = 0; z < shape.Box().size[2]; ++z)
  {
    for (std::int32_t y = 0; y < shape.Box().size[1]; ++y)
    {
      const auto    from = shape.Row(y, z);
      const auto    to = m_Shape.Row(y + kRoom, z + kRoom);
      std::uint64_t carry = 0;
      for (std::size_t word = 0; word < to.size(); ++word)
      {
        const std::uint64_t bits = word < from.size() ? from[word] : 0;
        to[word] = bits << kRoom | carry;
        carry = bits >> (64 - kRoom);
      }
    }
  }
}

} // namespace voxelcore
