#include "EndByVolume.h"

#include "BodyAtEnd.h"
#include "TubeEnd.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{

namespace
{

// How thick a branch is, is measured over so long a way before its cap: three radii, and 16 voxels, or a thin one is
// measured by too few.
constexpr double kSlabInRadii = 3;
constexpr double kSlabInVoxels = 16;

// A stub on a thick stem is too short to be measured: its balls tell how thick it is.
constexpr double kFreeCap = 0.6;    ///< of its cap must be free at least
constexpr double kStubRadius = 1.8; ///< voxels; of thinner stubs balls do not tell it well

} // namespace

std::optional<Vector3>
FindEndByVolume(const VoxelShape & shape,
                const Vector3 &    spacing,
                const WayLine &    line,
                double             free,
                double             radius,
                bool               isBar)
{
  EndLengths end;
  end.radius = radius;
  end.voxel = Length(spacing) / std::sqrt(3.0);
  end.way = line.way.back();
  end.deep = std::max(radius, end.voxel) + 0.5 * end.voxel;
  end.total = std::min(free, end.deep + std::max(kSlabInRadii * radius, kSlabInVoxels * end.voxel));
  end.skip = std::min(radius, 0.4 * end.total);
  end.isStub = end.total - end.deep < std::max(radius, 2 * end.voxel);
  end.isBar = isBar && end.isStub;
  if (end.isStub && !end.isBar && (end.total < kFreeCap * end.deep || radius < kStubRadius * end.voxel))
  {
    return std::nullopt;
  }
  const BodyAtEnd body(shape, spacing, line, end);
  const auto      cap = body.IsEmpty() ? std::nullopt : FindHalfBall(body, end);
  if (!cap)
  {
    return std::nullopt;
  }
  // The body's own axis: that of the samples.
  const double from = end.isStub ? end.skip - end.total : end.skip - end.deep - 2 * std::max(radius, 3 * end.voxel);
  return body.PlaceAt(cap->height + FlatEndAbove(body, end, *cap), from);
}

} // namespace voxelcore
