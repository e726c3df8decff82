#include "RootGrowth.h"

namespace voxelcore
{
VoxelShape
MakeRoot(const PhantomOptions & options, const ProgressCallback & progress)
{
  VoxelShape                    shape(VoxelBox{ { 0, 0, 0 }, options.size });
  const std::vector<GrownPoint> points = GrowRoot(options).points;
  const auto                    parentOf = [&](std::size_t i) -> const GrownPoint & {
    return points[points[i].parent < 0 ? i : static_cast<std::size_t>(points[i].parent)];
  };
  // The cones of each slab.
  std::vector<std::vector<std::uint32_t>> cones(
    static_cast<std::size_t>((options.size[2] + kPhantomSlab - 1) / kPhantomSlab));
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const GrownPoint & from = parentOf(i);
    const double       reach = std::max(from.radius, points[i].radius);
    const auto [low, high] = VoxelsWithin(options, 2, from.position[2], points[i].position[2], reach);
    for (std::int32_t slab = low / kPhantomSlab; slab * kPhantomSlab <= high; ++slab)
    {
      cones[static_cast<std::size_t>(slab)].push_back(static_cast<std::uint32_t>(i));
    }
  }
  ForSlabs(options, progress, [&](std::int32_t begin, std::int32_t end) {
    for (const std::uint32_t i : cones[static_cast<std::size_t>(begin / kPhantomSlab)])
    {
      VisitRoundCone(options,
                     parentOf(i),
                     points[i],
                     begin,
                     end - 1,
                     [&](std::int32_t x, std::int32_t y, std::int32_t z) { shape.Insert(x, y, z); });
    }
    shape.Compact(begin, end);
  });
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
