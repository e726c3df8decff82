#include "voxelcore/Shape/VoxelShape.h"

#include "voxelcore/Shape/ShapeBits.h"

#include "voxelcore/Base/CountBits.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

namespace voxelcore
{

VoxelShape::VoxelShape(const VoxelBox & box)
  : m_Box(box)
  , m_Bits(static_cast<std::size_t>(box.size[0]),
           static_cast<std::size_t>(box.size[1]),
           static_cast<std::size_t>(box.size[2]))
{}

std::uint64_t
VoxelShape::CountVoxels() const
{
  std::uint64_t count = 0;
  for (std::int32_t z = 0; z < m_Box.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < m_Box.size[1]; ++y)
    {
      const ConstShapeRow row = Row(y, z);
      for (std::size_t word = 0; word < row.size(); ++word)
      {
        if (row.Brick(word) != BitBricks::Out())
        {
          count += CountBits(row[word]);
        }
      }
    }
  }
  return count;
}

bool
ContainsInside(const VoxelShape & shape, const std::array<double, 3> & place)
{
  std::array<std::int32_t, 3> low{};
  std::array<std::int32_t, 3> high{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    high[axis] = static_cast<std::int32_t>(std::floor(place[axis]));
    low[axis] = static_cast<std::int32_t>(std::ceil(place[axis])) - 1;
  }
  for (std::int32_t z = low[2]; z <= high[2]; ++z)
  {
    for (std::int32_t y = low[1]; y <= high[1]; ++y)
    {
      for (std::int32_t x = low[0]; x <= high[0]; ++x)
      {
        if (!shape.Contains(x, y, z))
        {
          return false;
        }
      }
    }
  }
  return true;
}

VoxelBox
TightBox(const VoxelShape & shape)
{
  const VoxelBox &            box = shape.Box();
  std::array<std::int32_t, 3> first{ box.size };
  std::array<std::int32_t, 3> last{ -1, -1, -1 };
  for (std::int32_t z = 0; z < box.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < box.size[1]; ++y)
    {
      const ConstShapeRow row = shape.Row(y, z);
      std::size_t         head = 0;
      std::size_t         tail = row.size();
      while (head < tail && row[head] == 0)
      {
        ++head;
      }
      if (head == tail)
      {
        continue;
      }
      while (row[tail - 1] == 0)
      {
        --tail;
      }
      const auto low = static_cast<std::int32_t>(head * 64) + std::countr_zero(row[head]);
      const auto high = static_cast<std::int32_t>(tail * 64 - 1) - std::countl_zero(row[tail - 1]);
      first = { std::min(first[0], low), std::min(first[1], y), std::min(first[2], z) };
      last = { std::max(last[0], high), std::max(last[1], y), std::max(last[2], z) };
    }
  }
  if (last[0] < 0)
  {
    return { box.lower, { 0, 0, 0 } };
  }
  VoxelBox tight;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    tight.lower[axis] = box.lower[axis] + first[axis];
    tight.size[axis] = last[axis] - first[axis] + 1;
  }
  return tight;
}

void
PutInto(const VoxelShape & shape, VoxelShape & result)
{
  const VoxelBox &  box = shape.Box();
  const auto &      to = result.Box().lower;
  const auto        by = static_cast<std::size_t>(box.lower[0] - to[0]);
  const std::size_t skip = by / 64;
  const std::size_t shift = by % 64;
  for (std::int32_t z = 0; z < box.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < box.size[1]; ++y)
    {
      const ConstShapeRow from = shape.Row(y, z);
      const ShapeRow      row = result.Row(y + box.lower[1] - to[1], z + box.lower[2] - to[2]);
      for (std::size_t word = 0; word < from.size(); ++word)
      {
        const std::uint64_t bits = from[word];
        if (bits << shift != 0)
        {
          row[word + skip] |= bits << shift;
        }
        if (shift != 0 && bits >> (64 - shift) != 0)
        {
          row[word + skip + 1] |= bits >> (64 - shift);
        }
      }
    }
  }
}

VoxelShape
CopyBox(const VoxelShape & shape, const VoxelBox & box)
{
  VoxelShape                        result(box);
  const std::array<std::int32_t, 3> first{ box.lower[0] - shape.Box().lower[0],
                                           box.lower[1] - shape.Box().lower[1],
                                           box.lower[2] - shape.Box().lower[2] };
  const auto                        shift = static_cast<unsigned>(first[0]) & 63U;
  const auto                        skip = static_cast<std::size_t>(first[0]) / 64;
  const unsigned                    tailBits = static_cast<unsigned>(box.size[0]) & 63U;
  for (std::int32_t z = 0; z < box.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < box.size[1]; ++y)
    {
      const ConstShapeRow from = shape.Row(y + first[1], z + first[2]);
      const ShapeRow      to = result.Row(y, z);
      for (std::size_t word = 0; word < to.size(); ++word)
      {
        std::uint64_t bits = from[word + skip] >> shift;
        if (shift != 0 && word + skip + 1 < from.size())
        {
          bits |= from[word + skip + 1] << (64 - shift);
        }
        if (tailBits != 0 && word + 1 == to.size())
        {
          bits &= (std::uint64_t{ 1 } << tailBits) - 1;
        }
        to[word] = bits;
      }
    }
    if ((z & 7) == 7 || z + 1 == box.size[2])
    {
      result.Compact(z & ~7, z + 1);
    }
  }
  return result;
}

VoxelShape
Tightened(VoxelShape shape)
{
  const VoxelBox tight = TightBox(shape);
  if (tight.size != shape.Box().size)
  {
    return CopyBox(shape, tight);
  }
  shape.Compact();
  return shape;
}

VoxelShape
CropToVoxels(const VoxelShape & shape)
{
  return CopyBox(shape, TightBox(shape));
}

VoxelShape
CropToVoxels(VoxelShape && shape)
{
  const VoxelShape whole = std::exchange(shape, VoxelShape());
  return CropToVoxels(whole);
}

} // namespace voxelcore
