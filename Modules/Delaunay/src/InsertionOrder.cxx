#include "InsertionOrder.h"

#include <algorithm>
#include <bit>
#include <limits>
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

// A round by the trailing zeros of a hash: half of the points come in the last one, a quarter in the one before.
std::uint64_t
Round(std::uint64_t i)
{
  i = (i + 1) * 0x9E3779B97F4A7C15U;
  i = (i ^ (i >> 30)) * 0xBF58476D1CE4E5B9U;
  i ^= i >> 27;
  return static_cast<std::uint64_t>(std::min(std::countr_zero(i), 12));
}

} // namespace

std::vector<std::uint32_t>
InsertionOrder(const std::vector<LatticePoint> & points)
{
  LatticePoint low{ std::numeric_limits<std::int32_t>::max(),
                    std::numeric_limits<std::int32_t>::max(),
                    std::numeric_limits<std::int32_t>::max() };
  for (const LatticePoint & p : points)
  {
    low = { std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z) };
  }
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const LatticePoint & p = points[i];
    keys[i] = { (12 - Round(i)) << 60 | HilbertIndex(static_cast<std::uint32_t>(p.x - low.x),
                                                     static_cast<std::uint32_t>(p.y - low.y),
                                                     static_cast<std::uint32_t>(p.z - low.z)),
                static_cast<std::uint32_t>(i) };
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::uint32_t> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    order[i] = keys[i].second;
  }
  return order;
}

} // namespace voxelcore
