#include "voxelcore/VoxelShape.h"

#include "ShapeBits.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace voxelcore
{

VoxelShape::VoxelShape(const VoxelBox & box)
  : m_Box(box)
  , m_WordsPerRow((static_cast<std::size_t>(box.size[0]) + 63) / 64)
  , m_Words(m_WordsPerRow * static_cast<std::size_t>(box.size[1]) * static_cast<std::size_t>(box.size[2]), 0)
{}

std::uint64_t
VoxelShape::CountVoxels() const
{
  std::uint64_t count = 0;
  for (const std::uint64_t word : m_Words)
  {
    count += static_cast<std::uint64_t>(std::popcount(word));
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
      const auto row = shape.Row(y, z);
      const auto isSet = [](std::uint64_t word) { return word != 0; };
      const auto head = std::find_if(row.begin(), row.end(), isSet);
      if (head == row.end())
      {
        continue;
      }
      const auto tail = std::find_if(row.rbegin(), row.rend(), isSet);
      const auto low = static_cast<std::int32_t>((head - row.begin()) * 64 + std::countr_zero(*head));
      const auto high = static_cast<std::int32_t>((row.rend() - tail - 1) * 64 + 63 - std::countl_zero(*tail));
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

namespace
{

/** Copies the rows of `box` out of `shape` to where `rowAt` says. Rows may lie in the shape's own memory, before or on
 *  those they come from: each word is read before its place is written. */
template <typename RowAt>
void
CopyRows(const VoxelShape & shape, const VoxelBox & box, const RowAt & rowAt)
{
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
      const auto                     from = shape.Row(y + first[1], z + first[2]);
      const std::span<std::uint64_t> to = rowAt(y, z);
      for (std::size_t word = 0; word < to.size(); ++word)
      {
        std::uint64_t bits = from[word + skip] >> shift;
        if (shift != 0 && word + skip + 1 < from.size())
        {
          bits |= from[word + skip + 1] << (64 - shift);
        }
        to[word] = bits;
      }
      if (tailBits != 0)
      {
        to[to.size() - 1] &= (std::uint64_t{ 1 } << tailBits) - 1;
      }
    }
  }
}

} // namespace

VoxelShape
CopyBox(const VoxelShape & shape, const VoxelBox & box)
{
  VoxelShape result(box);
  CopyRows(shape, box, [&result](std::int32_t y, std::int32_t z) { return result.Row(y, z); });
  return result;
}

VoxelShape
Tightened(VoxelShape shape)
{
  const VoxelBox tight = TightBox(shape);
  return tight.size == shape.Box().size ? std::move(shape) : CopyBox(shape, tight);
}

VoxelShape
CropToVoxels(const VoxelShape & shape)
{
  return CopyBox(shape, TightBox(shape));
}

VoxelShape
CropToVoxels(VoxelShape && shape)
{
  const VoxelBox tight = TightBox(shape);
  VoxelShape     result;
  result.m_Box = tight;
  result.m_WordsPerRow = (static_cast<std::size_t>(tight.size[0]) + 63) / 64;
  std::size_t next = 0;
  CopyRows(shape, tight, [&](std::int32_t, std::int32_t) {
    const std::span<std::uint64_t> row(shape.m_Words.data() + next, result.m_WordsPerRow);
    next += result.m_WordsPerRow;
    return row;
  });
  shape.m_Words.resize(next);
  result.m_Words = std::move(shape.m_Words);
  shape = VoxelShape();
  return result;
}

} // namespace voxelcore
