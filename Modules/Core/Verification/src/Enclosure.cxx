#include "voxelcore/Verification/Enclosure.h"

#include "Checks.h"
#include "voxelcore/Base/ParallelTasks.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace voxelcore
{
namespace verification
{

/** A position within the tolerance of a plane between voxels must have the voxels on both sides in. No true vertex is
 *  that close to the boundary: the lattice points nearest to a point less than half a voxel above a boundary square are
 *  corners of that square alone, which lie in a plane. */
bool
IsInside(const VoxelShape & shape, const Position & position, double tolerance)
{
  std::array<std::array<std::int32_t, 2>, 3> range{};
  for (std::size_t a = 0; a < 3; ++a)
  {
    const double lower = std::ceil(position[a] - tolerance) - 1;
    const double upper = std::floor(position[a] + tolerance);
    const double limit = std::numeric_limits<std::int32_t>::max();
    if (!(lower > -limit && upper < limit && upper - lower <= 1))
    {
      return false;
    }
    range[a] = { static_cast<std::int32_t>(lower), static_cast<std::int32_t>(upper) };
  }
  for (const std::int32_t x : range[0])
  {
    for (const std::int32_t y : range[1])
    {
      for (const std::int32_t z : range[2])
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

} // namespace verification

bool
LieInside(const VoxelShape & shape, std::span<const std::array<double, 3>> places)
{
  std::atomic<bool>        all = true;
  std::atomic<std::size_t> seen = 0; // makers run their work in such parts, too: that none is lost is counted here
  RunInParts(places.size() > 10000, places.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last && all; ++i)
    {
      if (!verification::IsInside(shape, places[i], 0))
      {
        all = false;
      }
    }
    seen += last - first;
  });
  return all && seen == places.size();
}

} // namespace voxelcore
