#include "HilbertOrder.h"

#include "voxelcore/Base/ParallelTasks.h"

#include <algorithm>
#include <utility>

namespace voxelcore
{

namespace
{

// Position along a Hilbert curve of order 20 (Skilling 2004: axes to transposed index by Gray code, bit by bit).
std::uint64_t
HilbertIndex(std::uint32_t x, std::uint32_t y, std::uint32_t z)
{
  constexpr int bits = 20;
  std::uint32_t axes[3] = { x, y, z };
  for (std::uint32_t q = 1U << (bits - 1); q > 1; q >>= 1)
  {
    const std::uint32_t p = q - 1;
    for (std::uint32_t & axis : axes)
    {
      if (axis & q)
      {
        axes[0] ^= p;
      }
      else
      {
        const std::uint32_t t = (axes[0] ^ axis) & p;
        axes[0] ^= t;
        axis ^= t;
      }
    }
  }
  axes[1] ^= axes[0];
  axes[2] ^= axes[1];
  std::uint32_t t = 0;
  for (std::uint32_t q = 1U << (bits - 1); q > 1; q >>= 1)
  {
    if (axes[2] & q)
    {
      t ^= q - 1;
    }
  }
  std::uint64_t index = 0;
  for (int bit = bits - 1; bit >= 0; --bit)
  {
    for (const std::uint32_t axis : axes)
    {
      index = index << 1 | (((axis ^ t) >> bit) & 1U);
    }
  }
  return index;
}

} // namespace

void
SortAlongCurve(const std::vector<LatticePoint> & points, std::vector<std::uint32_t> & chosen)
{
  if (chosen.empty())
  {
    return;
  }
  LatticePoint low = points[chosen[0]];
  for (const std::uint32_t p : chosen)
  {
    low = { std::min(low.x, points[p].x), std::min(low.y, points[p].y), std::min(low.z, points[p].z) };
  }
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys(chosen.size());
  RunInParts(chosen.size() > 10000, chosen.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
    {
      const LatticePoint & p = points[chosen[i]];
      keys[i] = { HilbertIndex(static_cast<std::uint32_t>(p.x - low.x),
                               static_cast<std::uint32_t>(p.y - low.y),
                               static_cast<std::uint32_t>(p.z - low.z)),
                  chosen[i] };
    }
  });
  const auto middle = keys.begin() + static_cast<std::ptrdiff_t>(keys.size() / 2);
  std::nth_element(keys.begin(), middle, keys.end());
  RunBoth(
    keys.size() > 10000,
    [&] { std::sort(keys.begin(), middle); },
    [&] { std::sort(middle, keys.end()); });
  std::transform(keys.begin(), keys.end(), chosen.begin(), [](const auto & key) { return key.second; });
}

} // namespace voxelcore
