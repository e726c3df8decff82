#pragma once
// Noise on the surface of a shape.

#include "VoxelCoreTesting/Shapes.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <random>
#include <vector>

namespace voxelcore::testing
{

/** Whether a voxel may change sides without a change of topology: around it there is one piece of the shape (across
 *  faces, next to it) and one of the background. `isIn[13]` is the voxel itself, x fastest. */
inline bool
IsSimple(const std::array<bool, 27> & isIn)
{
  const auto pieces = [&](bool inside) {
    std::array<bool, 27> seen{};
    int                  count = 0;
    for (int start = 0; start < 27; ++start)
    {
      const auto part = [](int at) { return std::array<int, 3>{ at % 3 - 1, at / 3 % 3 - 1, at / 9 - 1 }; };
      const auto away = [](const std::array<int, 3> & d) { return std::abs(d[0]) + std::abs(d[1]) + std::abs(d[2]); };
      const auto takes = [&](int at) {
        return at != 13 && isIn[static_cast<std::size_t>(at)] == inside && !seen[static_cast<std::size_t>(at)] &&
               (!inside || away(part(at)) <= 2);
      };
      if (!takes(start) || (inside && away(part(start)) != 1))
      {
        continue;
      }
      ++count;
      std::vector<int> open{ start };
      seen[static_cast<std::size_t>(start)] = true;
      while (!open.empty())
      {
        const auto from = part(open.back());
        open.pop_back();
        for (int at = 0; at < 27; ++at)
        {
          const auto to = part(at);
          const auto step = std::array<int, 3>{ to[0] - from[0], to[1] - from[1], to[2] - from[2] };
          const bool isNext =
            inside ? away(step) == 1 : std::max({ std::abs(step[0]), std::abs(step[1]), std::abs(step[2]) }) == 1;
          if (isNext && takes(at))
          {
            seen[static_cast<std::size_t>(at)] = true;
            open.push_back(at);
          }
        }
      }
    }
    return count;
  };
  return pieces(true) == 1 && pieces(false) == 1;
}

/** Flips five percent of the voxels that have a neighbour across a face on the other side of the boundary; with
 *  `simple` one after another, and only those whose flip leaves the topology as it is. */
inline VoxelShape
Flipped(const VoxelShape & shape, std::int32_t n, std::uint64_t seed, bool simple)
{
  std::mt19937_64           random(seed);
  const auto                side = static_cast<std::size_t>(n) + 2;
  std::vector<std::uint8_t> voxels(side * side * side, 0);
  const auto                at = [&](int x, int y, int z) {
    return (static_cast<std::size_t>(z + 1) * side + static_cast<std::size_t>(y + 1)) * side +
           static_cast<std::size_t>(x + 1);
  };
  const auto forAll = [n](const auto & visit) {
    for (int z = 0; z < n; ++z)
    {
      for (int y = 0; y < n; ++y)
      {
        for (int x = 0; x < n; ++x)
        {
          visit(x, y, z);
        }
      }
    }
  };
  forAll([&](int x, int y, int z) { voxels[at(x, y, z)] = shape.Contains(x, y, z) ? 1 : 0; });
  const std::vector<std::uint8_t> clean = voxels;
  forAll([&](int x, int y, int z) {
    const auto in = clean[at(x, y, z)];
    const bool isBoundary = clean[at(x - 1, y, z)] != in || clean[at(x + 1, y, z)] != in ||
                            clean[at(x, y - 1, z)] != in || clean[at(x, y + 1, z)] != in ||
                            clean[at(x, y, z - 1)] != in || clean[at(x, y, z + 1)] != in;
    if (!isBoundary || random() % 20 != 0)
    {
      return;
    }
    std::array<bool, 27> around{};
    for (int k = 0; k < 27; ++k)
    {
      around[static_cast<std::size_t>(k)] = voxels[at(x + k % 3 - 1, y + k / 3 % 3 - 1, z + k / 9 - 1)] != 0;
    }
    if (!simple || IsSimple(around))
    {
      voxels[at(x, y, z)] = in ^ 1U;
    }
  });
  return ShapeWhere({ n, n, n }, [&](int x, int y, int z) { return voxels[at(x, y, z)] != 0; });
}

} // namespace voxelcore::testing
