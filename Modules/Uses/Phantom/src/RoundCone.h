#pragma once
// The voxels of a round cone, the hull of two balls, of which branches are made, and directions for their growth.

#include "Kinds.h"
#include "SplitMix64.h"
#include "voxelcore/Lattice/Vectors.h"

#include <cmath>
#include <utility>

namespace voxelcore
{

inline Vector3
Direction(const Vector3 & a)
{
  const double length = std::sqrt(Dot(a, a));
  return length > 0 ? Vector3{ a[0] / length, a[1] / length, a[2] / length } : Vector3{ 0, 0, -1 };
}

/** Evenly spread over the ball of radius 1. */
inline Vector3
RandomInBall(SplitMix64 & random)
{
  for (;;)
  {
    const Vector3 v{ random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1) };
    if (Dot(v, v) <= 1)
    {
      return v;
    }
  }
}

/** A ball in mm from the grid's corner. */
struct ConeEnd
{
  Vector3 position{};
  double  radius = 0;
};

/** The voxels, first and last, whose centres may lie within `reach` mm of the segment from a to b along an axis; none
 *  when the last comes before the first. */
inline std::pair<std::int32_t, std::int32_t>
VoxelsWithin(const PhantomOptions & options, std::size_t axis, double a, double b, double reach)
{
  const double spacing = options.spacing[axis];
  const double last = options.size[axis] - 1;
  const double least = std::floor((std::min(a, b) - reach) / spacing - 0.5);
  const double most = std::ceil((std::max(a, b) + reach) / spacing - 0.5);
  return { static_cast<std::int32_t>(std::clamp(least, 0.0, last + 1)),
           static_cast<std::int32_t>(std::clamp(most, -1.0, last)) };
}

/** Calls visit(x, y, z) for each voxel of the planes firstZ to lastZ whose centre lies in the cone. */
template <typename Visit>
void
VisitRoundCone(const PhantomOptions & options,
               const ConeEnd &        a,
               const ConeEnd &        b,
               std::int32_t           firstZ,
               std::int32_t           lastZ,
               Visit &&               visit)
{
  const double reach = std::max(a.radius, b.radius);
  const auto   within = [&](std::size_t axis) {
    return VoxelsWithin(options, axis, a.position[axis], b.position[axis], reach);
  };
  const auto [lowX, highX] = within(0);
  const auto [lowY, highY] = within(1);
  const auto [lowZ, highZ] = within(2);
  const Vector3 along = Minus(b.position, a.position);
  const double  squared = Dot(along, along);
  for (std::int32_t z = std::max(lowZ, firstZ); z <= std::min(highZ, lastZ); ++z)
  {
    for (std::int32_t y = lowY; y <= highY; ++y)
    {
      for (std::int32_t x = lowX; x <= highX; ++x)
      {
        const Vector3 centre{ (x + 0.5) * options.spacing[0],
                              (y + 0.5) * options.spacing[1],
                              (z + 0.5) * options.spacing[2] };
        const Vector3 offset = Minus(centre, a.position);
        const double  t = squared > 0 ? std::clamp(Dot(offset, along) / squared, 0.0, 1.0) : 0.0;
        const Vector3 away = AddScaled(offset, -t, along);
        const double  radius = a.radius + t * (b.radius - a.radius);
        if (Dot(away, away) <= radius * radius)
        {
          visit(x, y, z);
        }
      }
    }
  }
}

} // namespace voxelcore
