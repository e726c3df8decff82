#include "RootGrowth.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{
namespace
{

/** Puts in the voxels whose centre lies in the round cone between two points. */
void
PaintCone(VoxelShape & shape, const PhantomOptions & options, const GrownPoint & a, const GrownPoint & b)
{
  const double                reach = std::max(a.radius, b.radius);
  std::array<std::int32_t, 3> low{};
  std::array<std::int32_t, 3> high{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double spacing = options.spacing[axis];
    const double least = std::min(a.position[axis], b.position[axis]) - reach;
    const double most = std::max(a.position[axis], b.position[axis]) + reach;
    low[axis] = std::max(0, static_cast<std::int32_t>(std::floor(least / spacing - 0.5)));
    high[axis] = std::min(options.size[axis] - 1, static_cast<std::int32_t>(std::ceil(most / spacing - 0.5)));
  }
  const Vector3 along = Sum(b.position, a.position, -1);
  const double  squared = Dot(along, along);
  for (std::int32_t z = low[2]; z <= high[2]; ++z)
  {
    for (std::int32_t y = low[1]; y <= high[1]; ++y)
    {
      for (std::int32_t x = low[0]; x <= high[0]; ++x)
      {
        const Vector3 centre{ (x + 0.5) * options.spacing[0],
                              (y + 0.5) * options.spacing[1],
                              (z + 0.5) * options.spacing[2] };
        const Vector3 offset = Sum(centre, a.position, -1);
        const double  t = squared > 0 ? std::clamp(Dot(offset, along) / squared, 0.0, 1.0) : 0.0;
        const Vector3 away = Sum(offset, along, -t);
        const double  radius = a.radius + t * (b.radius - a.radius);
        if (Dot(away, away) <= radius * radius)
        {
          shape.Insert(x, y, z);
        }
      }
    }
  }
}

} // namespace

VoxelShape
MakeRoot(const PhantomOptions & options, const ProgressCallback & progress)
{
  VoxelShape                    shape(VoxelBox{ { 0, 0, 0 }, options.size });
  const std::vector<GrownPoint> points = GrowRoot(options);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (i % 64 == 0)
    {
      ReportProgress(progress, "sampling", static_cast<double>(i) / static_cast<double>(points.size()));
    }
    const std::int64_t parent = points[i].parent;
    PaintCone(shape, options, points[parent < 0 ? i : static_cast<std::size_t>(parent)], points[i]);
  }
  return shape;
}

std::vector<CentreLinePoint>
CentreLinesOfRoot(const PhantomOptions & options)
{
  std::vector<CentreLinePoint> lines;
  for (const GrownPoint & point : GrowRoot(options))
  {
    const Vector3 lattice{ point.position[0] / options.spacing[0],
                           point.position[1] / options.spacing[1],
                           point.position[2] / options.spacing[2] };
    lines.push_back({ lattice, point.radius, point.parent, point.branch, point.order });
  }
  return lines;
}

} // namespace voxelcore
