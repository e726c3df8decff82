#include "RootGrowth.h"

namespace voxelcore
{
VoxelShape
MakeRoot(const PhantomOptions & options, const ProgressCallback & progress)
{
  VoxelShape                    shape(VoxelBox{ { 0, 0, 0 }, options.size });
  const std::vector<GrownPoint> points = GrowRoot(options).points;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (i % 64 == 0)
    {
      ReportProgress(progress, "sampling", static_cast<double>(i) / static_cast<double>(points.size()));
    }
    const std::int64_t parent = points[i].parent;
    const GrownPoint & from = points[parent < 0 ? i : static_cast<std::size_t>(parent)];
    VisitRoundCone(options,
                   from,
                   points[i],
                   0,
                   options.size[2] - 1,
                   [&](std::int32_t x, std::int32_t y, std::int32_t z) { shape.Insert(x, y, z); });
  }
  return shape;
}

std::vector<CentreLinePoint>
CentreLinesOfRoot(const PhantomOptions & options)
{
  std::vector<CentreLinePoint> lines;
  for (const GrownPoint & point : GrowRoot(options).points)
  {
    const Vector3 lattice{ point.position[0] / options.spacing[0],
                           point.position[1] / options.spacing[1],
                           point.position[2] / options.spacing[2] };
    lines.push_back({ lattice, point.radius, point.parent, point.branch, point.order });
  }
  return lines;
}

std::vector<RootContact>
ContactsOfRoot(const PhantomOptions & options)
{
  std::vector<RootContact> contacts;
  for (const GrownContact & contact : GrowRoot(options).contacts)
  {
    contacts.push_back({ { contact.position[0] / options.spacing[0],
                           contact.position[1] / options.spacing[1],
                           contact.position[2] / options.spacing[2] },
                         contact.branches });
  }
  return contacts;
}

} // namespace voxelcore
