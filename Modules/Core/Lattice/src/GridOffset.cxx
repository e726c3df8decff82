#include "voxelcore/Lattice/GridOffset.h"

#include <cmath>

namespace voxelcore
{

std::optional<std::array<std::int32_t, 3>>
GridOffset(const ImageGeometry & grid, const ImageGeometry & other, double close)
{
  std::array<std::int32_t, 3> offset{};
  for (int corner = 0; corner < 8; ++corner)
  {
    Vector3 place{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      place[axis] = (corner >> axis & 1) != 0 ? static_cast<double>(other.size[axis]) : 0.0;
    }
    const Vector3 there = PhysicalToLattice(grid, LatticeToPhysical(other, place));
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double by = there[axis] - place[axis];
      if (!(std::abs(by) < 1e9)) // numbers of voxels have 32 bits
      {
        return std::nullopt;
      }
      if (corner == 0)
      {
        offset[axis] = static_cast<std::int32_t>(std::lround(by));
      }
      if (!(std::abs(by - offset[axis]) < close))
      {
        return std::nullopt;
      }
    }
  }
  return offset;
}

bool
HaveSameVoxels(const ImageGeometry & grid, const ImageGeometry & other, double close)
{
  return grid.size == other.size && grid.unit == other.unit &&
         GridOffset(grid, other, close) == std::array<std::int32_t, 3>{};
}

} // namespace voxelcore
