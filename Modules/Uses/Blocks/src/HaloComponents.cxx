#include "HaloComponents.h"

#include "BoundaryBits.h"

#include "voxelcore/Shape/ShapeOperations.h"

#include <algorithm>
#include <utility>

namespace voxelcore
{

namespace
{

using Place = std::array<std::int32_t, 3>;

// Whether the shape has voxels in the range.
bool
Meets(const VoxelShape & shape, const VoxelBox & range)
{
  const VoxelBox & box = shape.Box();
  Place            lower{};
  Place            upper{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    lower[axis] = std::max(range.lower[axis] - box.lower[axis], 0);
    upper[axis] = std::min(range.lower[axis] + range.size[axis] - box.lower[axis], box.size[axis]);
  }
  for (std::int32_t z = lower[2]; z < upper[2]; ++z)
  {
    for (std::int32_t y = lower[1]; y < upper[1]; ++y)
    {
      const auto row = shape.Row(y, z);
      for (std::int32_t word = lower[0] >> 6; word << 6 < upper[0]; ++word)
      {
        if ((row[static_cast<std::size_t>(word)] & BoundaryBits::Between(lower[0], upper[0], word)) != 0)
        {
          return true;
        }
      }
    }
  }
  return false;
}

} // namespace

void
Include(const VoxelShape & part, VoxelShape & shape)
{
  Place at{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    at[axis] = part.Box().lower[axis] - shape.Box().lower[axis];
  }
  const auto shift = static_cast<unsigned>(at[0]) & 63U;
  const auto skip = static_cast<std::size_t>(at[0]) / 64;
  for (std::int32_t z = 0; z < part.Box().size[2]; ++z)
  {
    for (std::int32_t y = 0; y < part.Box().size[1]; ++y)
    {
      const auto from = part.Row(y, z);
      const auto to = shape.Row(y + at[1], z + at[2]);
      for (std::size_t word = 0; word < from.size(); ++word)
      {
        to[word + skip] |= from[word] << shift;
        if (shift != 0 && from[word] >> (64 - shift) != 0)
        {
          to[word + skip + 1] |= from[word] >> (64 - shift);
        }
      }
    }
  }
}

VoxelShape
ComponentsThatMeet(const VoxelShape & shape, const VoxelBox & range)
{
  std::vector<VoxelShape> kept = SplitComponents(shape);
  std::erase_if(kept, [&](const VoxelShape & component) { return !Meets(component, range); });
  if (kept.empty())
  {
    return {};
  }
  if (kept.size() == 1)
  {
    return std::move(kept[0]);
  }
  VoxelBox box = kept[0].Box();
  for (const VoxelShape & component : kept)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const VoxelBox &   other = component.Box();
      const std::int32_t end = std::max(box.lower[axis] + box.size[axis], other.lower[axis] + other.size[axis]);
      box.lower[axis] = std::min(box.lower[axis], other.lower[axis]);
      box.size[axis] = end - box.lower[axis];
    }
  }
  VoxelShape result(box);
  for (const VoxelShape & component : kept)
  {
    Include(component, result);
  }
  return result;
}

} // namespace voxelcore
