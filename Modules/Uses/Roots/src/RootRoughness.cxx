#include "voxelcore/Roots/RootRoughness.h"

#include "voxelcore/Base/Library.h"
#include "voxelcore/Skeleton/BranchTable.h"
#include "voxelcore/VoxelCore/BallTree.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{

namespace
{

constexpr double kDeviationsOfMedian = 1.4826; // of the standard deviation, where distances are normal

double
MedianOf(std::vector<double> & values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double
Scatter(std::vector<double> values)
{
  if (values.empty())
  {
    return 0;
  }
  const double median = MedianOf(values);
  for (double & value : values)
  {
    value = std::abs(value - median);
  }
  return kDeviationsOfMedian * MedianOf(values);
}

double
LengthOf(const SkeletonGraph & graph)
{
  double length = 0;
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    length += graph.BranchLength(branch);
  }
  return length;
}

} // namespace

std::vector<double>
RootRoughness(const VoxelShape &    shape,
              const ImageGeometry & geometry,
              const SkeletonGraph & graph,
              const RootHierarchy & roots)
{
  std::vector<ElementIndex> rootAt(graph.positions.size(), kNoRoot);
  for (ElementIndex axis = 0; axis < roots.axes.size(); ++axis)
  {
    for (const ElementIndex point : roots.axes[axis].points)
    {
      rootAt[point] = std::min(rootAt[point], axis); // parents stand before their children
    }
  }
  std::vector<Vector3>      places;
  std::vector<double>       radii;
  std::vector<ElementIndex> owners;
  for (ElementIndex point = 0; point < rootAt.size(); ++point)
  {
    if (rootAt[point] != kNoRoot)
    {
      places.push_back(PhysicalToLattice(geometry, graph.positions[point]));
      radii.push_back(SectionRadii(graph)[point]);
      owners.push_back(rootAt[point]);
    }
  }
  std::vector<std::vector<double>> away(roots.axes.size());
  const BallTree                   balls(places, radii, ComputeSpacingWeights(geometry.spacing));
  const VoxelBox                   box = shape.Box();
  std::size_t                      nearest = 0;
  for (std::int32_t z = box.lower[2]; z < box.lower[2] + box.size[2] && !places.empty(); ++z)
  {
    for (std::int32_t y = box.lower[1]; y < box.lower[1] + box.size[1]; ++y)
    {
      for (std::int32_t x = box.lower[0]; x < box.lower[0] + box.size[0]; ++x)
      {
        if (shape.Contains(x, y, z) &&
            !(shape.Contains(x - 1, y, z) && shape.Contains(x + 1, y, z) && shape.Contains(x, y - 1, z) &&
              shape.Contains(x, y + 1, z) && shape.Contains(x, y, z - 1) && shape.Contains(x, y, z + 1)))
        {
          const double gap = balls.Gap({ x + 0.5, y + 0.5, z + 0.5 }, -HUGE_VAL, nearest);
          away[owners[balls.BallOf(nearest)]].push_back(gap);
        }
      }
    }
  }
  std::vector<double> ofRoot(away.size());
  ranges::transform(away, ofRoot.begin(), Scatter);
  std::vector<double> roughness(rootAt.size(), 0);
  for (std::size_t point = 0; point < roughness.size(); ++point)
  {
    roughness[point] = rootAt[point] != kNoRoot ? ofRoot[rootAt[point]] : 0;
  }
  return roughness;
}

RootBulges
LeaveOutBulges(const VoxelShape & shape, const ImageGeometry & geometry, const RootRules & rules, SkeletonGraph & graph)
{
  RootBulges bulges;
  if (rules.bulge > 0)
  {
    const double before = LengthOf(graph);
    bulges.count = PruneBulges(graph, RootRoughness(shape, geometry, graph, FindRoots(graph, rules)), rules.bulge);
    bulges.length = bulges.count > 0 ? before - LengthOf(graph) : 0;
  }
  return bulges;
}

} // namespace voxelcore
