#pragma once
// Grey volumes with three levels, for topological simplification.

#include "VoxelCoreTesting/Shapes.h"

#include "voxelcore/Masks/TopologySimplification.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace voxelcore::testing
{

/** Grey values in a box, and the shapes at or above three levels. */
struct GreyCase
{
  Size3                      size{};
  std::vector<std::uint32_t> grey;
  std::uint32_t              levels[3]{}; // neighbourhood, shape, kernel

  std::uint32_t
  At(int x, int y, int z) const
  {
    return grey[(static_cast<std::size_t>(z) * static_cast<std::size_t>(size[1]) + static_cast<std::size_t>(y)) *
                  static_cast<std::size_t>(size[0]) +
                static_cast<std::size_t>(x)];
  }

  VoxelShape
  Level(int which) const
  {
    return ShapeWhere(size, [&](int x, int y, int z) { return At(x, y, z) >= levels[which]; });
  }

  std::uint32_t
  Cost(int x, int y, int z) const
  {
    const std::uint32_t value = At(x, y, z);
    return value >= levels[1] ? value - levels[1] + 1 : levels[1] - value;
  }

  SimplifiedShape
  Run(const TopologyRequest & request = {}) const
  {
    return SimplifyTopology(
      Level(2),
      Level(1),
      Level(0),
      [this](int x, int y, int z) { return Cost(x, y, z); },
      request);
  }
};

/** Smooth noise: sums of random boxes' values, distinct by a last digit. */
inline GreyCase
RandomGrey(std::uint64_t seed, std::int64_t most)
{
  Random   random(seed);
  GreyCase grey;
  for (auto & side : grey.size)
  {
    side = static_cast<std::int32_t>(random.Between(4, most));
  }
  const auto n = static_cast<std::size_t>(grey.size[0]) * static_cast<std::size_t>(grey.size[1]) *
                 static_cast<std::size_t>(grey.size[2]);
  std::vector<std::uint32_t> raw(n);
  for (auto & value : raw)
  {
    value = static_cast<std::uint32_t>(random.Between(0, 255));
  }
  grey.grey.resize(n);
  std::size_t i = 0;
  for (std::int32_t z = 0; z < grey.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < grey.size[1]; ++y)
    {
      for (std::int32_t x = 0; x < grey.size[0]; ++x, ++i)
      {
        std::uint32_t sum = 0;
        std::uint32_t count = 0;
        for (int k = 0; k < 27; ++k)
        {
          const std::int32_t at[3]{ x + k % 3 - 1, y + k / 3 % 3 - 1, z + k / 9 - 1 };
          if (at[0] >= 0 && at[1] >= 0 && at[2] >= 0 && at[0] < grey.size[0] && at[1] < grey.size[1] &&
              at[2] < grey.size[2])
          {
            sum += raw[static_cast<std::size_t>((at[2] * grey.size[1] + at[1]) * grey.size[0] + at[0])];
            ++count;
          }
        }
        grey.grey[i] = sum * 1000 / count;
      }
    }
  }
  auto sorted = grey.grey;
  std::ranges::sort(sorted);
  grey.levels[0] = sorted[n * 40 / 100];
  grey.levels[1] = sorted[n * 55 / 100];
  grey.levels[2] = sorted[n * 75 / 100];
  return grey;
}

} // namespace voxelcore::testing
