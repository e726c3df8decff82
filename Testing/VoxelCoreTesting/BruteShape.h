#pragma once
// A voxel shape's boundary vertices and topology numbers, voxel by voxel as their definitions say: slow and plain.

#include "voxelcore/Lattice/TopologyNumbers.h"
#include "voxelcore/Shape/VoxelShape.h"

#include <cstdlib>
#include <vector>

namespace voxelcore::testing
{

/** How many of the voxels between low and high (both included) are in. */
inline int
CountIn(const VoxelShape & shape, const LatticePoint & low, const LatticePoint & high)
{
  int count = 0;
  for (std::int32_t z = low.z; z <= high.z; ++z)
  {
    for (std::int32_t y = low.y; y <= high.y; ++y)
    {
      for (std::int32_t x = low.x; x <= high.x; ++x)
      {
        count += shape.Contains(x, y, z) ? 1 : 0;
      }
    }
  }
  return count;
}

/** Calls visit(x, y, z) for all lattice corners of the shape's box, x fastest. */
template <typename TVisit>
void
VisitCorners(const VoxelShape & shape, TVisit visit)
{
  const auto & [lower, size] = shape.Box();
  for (std::int32_t z = lower[2]; z <= lower[2] + size[2]; ++z)
  {
    for (std::int32_t y = lower[1]; y <= lower[1] + size[1]; ++y)
    {
      for (std::int32_t x = lower[0]; x <= lower[0] + size[0]; ++x)
      {
        visit(x, y, z);
      }
    }
  }
}

inline std::vector<LatticePoint>
BruteBoundaryVertices(const VoxelShape & shape)
{
  std::vector<LatticePoint> points;
  VisitCorners(shape, [&](std::int32_t x, std::int32_t y, std::int32_t z) {
    const int in = CountIn(shape, { x - 1, y - 1, z - 1 }, { x, y, z });
    if (in != 0 && in != 8)
    {
      points.push_back({ x, y, z });
    }
  });
  return points;
}

/** Components of the voxels (value true) or of the background of the box grown by one voxel (value false); neighbours
 *  differ by at most one along each axis and by at most `steps` axes. */
inline std::int64_t
BruteComponents(const VoxelShape & shape, bool value, int steps)
{
  const auto & [lower, size] = shape.Box();
  const std::int32_t        wide = size[0] + 2;
  const std::int32_t        deep = size[1] + 2;
  const std::int32_t        high = size[2] + 2;
  std::vector<std::uint8_t> open(static_cast<std::size_t>(wide) * deep * high);
  const auto                at = [&](std::int32_t x, std::int32_t y, std::int32_t z) -> std::uint8_t & {
    return open[(static_cast<std::size_t>(z) * deep + y) * wide + x];
  };
  for (std::int32_t z = 0; z < high; ++z)
  {
    for (std::int32_t y = 0; y < deep; ++y)
    {
      for (std::int32_t x = 0; x < wide; ++x)
      {
        at(x, y, z) = shape.Contains(lower[0] + x - 1, lower[1] + y - 1, lower[2] + z - 1) == value;
      }
    }
  }
  std::int64_t              components = 0;
  std::vector<LatticePoint> front;
  for (std::int32_t z = 0; z < high; ++z)
  {
    for (std::int32_t y = 0; y < deep; ++y)
    {
      for (std::int32_t x = 0; x < wide; ++x)
      {
        if (!at(x, y, z))
        {
          continue;
        }
        ++components;
        at(x, y, z) = 0;
        front.push_back({ x, y, z });
        while (!front.empty())
        {
          const LatticePoint p = front.back();
          front.pop_back();
          for (int step = 0; step < 27; ++step)
          {
            const LatticePoint d{ step % 3 - 1, step / 3 % 3 - 1, step / 9 - 1 };
            const LatticePoint q{ p.x + d.x, p.y + d.y, p.z + d.z };
            if (std::abs(d.x) + std::abs(d.y) + std::abs(d.z) <= steps && q.x >= 0 && q.y >= 0 && q.z >= 0 &&
                q.x < wide && q.y < deep && q.z < high && at(q.x, q.y, q.z))
            {
              at(q.x, q.y, q.z) = 0;
              front.push_back(q);
            }
          }
        }
      }
    }
  }
  return components;
}

/** Open cells counted one by one: an inner face, edge or corner has all its 2, 4 or 8 voxels in. */
inline TopologyNumbers
BruteTopology(const VoxelShape & shape)
{
  TopologyNumbers numbers;
  VisitCorners(shape, [&](std::int32_t x, std::int32_t y, std::int32_t z) {
    // The eight cells that have this corner as their greatest voxel's: grown by one voxel along any set of axes.
    for (int axes = 0; axes < 8; ++axes)
    {
      const int          dx = axes & 1;
      const int          dy = axes >> 1 & 1;
      const int          dz = axes >> 2;
      const LatticePoint low{ x - dx, y - dy, z - dz };
      const bool         inner = CountIn(shape, low, { x, y, z }) == 1 << (dx + dy + dz);
      numbers.euler += inner ? ((dx + dy + dz) % 2 == 0 ? 1 : -1) : 0;
    }
  });
  numbers.betti[0] = BruteComponents(shape, true, 1);
  numbers.betti[2] = BruteComponents(shape, false, 3) - 1;
  numbers.betti[1] = numbers.betti[0] + numbers.betti[2] - numbers.euler;
  return numbers;
}

} // namespace voxelcore::testing
