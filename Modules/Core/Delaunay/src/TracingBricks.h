#pragma once
// Bricks of 32^3 voxels over the box of a shape: the order in which tracers work, and how threads share it.

#include "LatticeWindow.h"

#include <algorithm>

namespace voxelcore
{

/** Bricks in scan order (x fastest). */
struct TracingBricks
{
  LatticePoint                lower{};
  std::array<std::int32_t, 3> count{};

  explicit TracingBricks(const VoxelBox & box)
    : lower{ box.lower[0], box.lower[1], box.lower[2] }
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      count[axis] = (box.size[axis] + LatticeWindow::brick - 1) / LatticeWindow::brick;
    }
  }

  std::size_t
  Size() const
  {
    return static_cast<std::size_t>(count[0]) * static_cast<std::size_t>(count[1]) * static_cast<std::size_t>(count[2]);
  }

  /** The lattice corner where a brick starts. */
  LatticePoint
  Corner(std::size_t brick) const
  {
    const auto nx = static_cast<std::size_t>(count[0]);
    const auto ny = static_cast<std::size_t>(count[1]);
    return { lower.x + LatticeWindow::brick * static_cast<std::int32_t>(brick % nx),
             lower.y + LatticeWindow::brick * static_cast<std::int32_t>(brick / nx % ny),
             lower.z + LatticeWindow::brick * static_cast<std::int32_t>(brick / nx / ny) };
  }

  /** The brick of a voxel; voxels beyond the box count to the nearest brick. */
  std::size_t
  At(std::int32_t x, std::int32_t y, std::int32_t z) const
  {
    // Bricks before the first count to it: rounded towards it, or down.
    static_assert(LatticeWindow::brick == 1 << 5);
    const auto place = [](std::int32_t offset, std::int32_t n) {
      return static_cast<std::size_t>(std::clamp(offset >> 5, 0, n - 1));
    };
    return (place(z - lower.z, count[2]) * static_cast<std::size_t>(count[1]) + place(y - lower.y, count[1])) *
             static_cast<std::size_t>(count[0]) +
           place(x - lower.x, count[0]);
  }
};

/** How many of the points each brick holds, those on its sides included: a brick with none has nothing to start
 *  from. */
std::vector<std::uint32_t>
BrickLoad(const TracingBricks & grid, const std::vector<LatticePoint> & points);

} // namespace voxelcore
