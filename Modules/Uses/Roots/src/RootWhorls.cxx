#include "RootWhorls.h"

#include "voxelcore/Skeleton/BranchTable.h"
#include "voxelcore/Base/Library.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace voxelcore
{

void
FindWhorls(const SkeletonGraph & graph, const RootRules & rules, RootHierarchy & roots)
{
  const std::vector<double> & radii = SectionRadii(graph);
  for (ElementIndex stem = 0; stem < roots.axes.size() && roots.axes[stem].level == 0; ++stem)
  {
    const auto &        line = roots.axes[stem].points;
    std::vector<double> way(line.size(), 0);
    for (std::size_t i = 1; i < line.size(); ++i)
    {
      way[i] = way[i - 1] + Distance(graph.positions[line[i - 1]], graph.positions[line[i]]);
    }
    std::vector<std::pair<double, ElementIndex>> laterals;
    for (ElementIndex axis = 0; axis < roots.axes.size(); ++axis)
    {
      if (roots.axes[axis].parent == stem)
      {
        laterals.emplace_back(way[roots.axes[axis].parentPoint], axis);
      }
    }
    std::sort(laterals.begin(), laterals.end());
    for (std::size_t first = 0; first < laterals.size();)
    {
      RootWhorl   whorl{ stem, 0, {}, {} };
      std::size_t last = first;
      for (;; ++last)
      {
        const auto [along, axis] = laterals[last];
        const ElementIndex point = line[roots.axes[axis].parentPoint];
        whorl.roots.push_back(axis);
        whorl.along += along;
        whorl.position = AddScaled(whorl.position, 1, graph.positions[point]);
        if (last + 1 == laterals.size() || laterals[last + 1].first - along > rules.whorlGap * radii[point])
        {
          break;
        }
      }
      const auto count = static_cast<double>(whorl.roots.size());
      whorl.along /= count;
      whorl.position = { whorl.position[0] / count, whorl.position[1] / count, whorl.position[2] / count };
      if (whorl.roots.size() >= static_cast<std::size_t>(rules.whorlSize))
      {
        roots.whorls.push_back(std::move(whorl));
      }
      first = last + 1;
    }
  }
}

std::size_t
NearestPoint(const SkeletonGraph & graph, const std::vector<ElementIndex> & line, const Vector3 & place)
{
  std::size_t found = 0;
  double      nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < line.size(); ++i)
  {
    const double away = Distance(graph.positions[line[i]], place);
    if (away < nearest)
    {
      nearest = away;
      found = i;
    }
  }
  return found;
}

std::vector<ElementIndex>
SortByLevel(RootHierarchy & roots)
{
  std::vector<ElementIndex> order(roots.axes.size());
  std::iota(order.begin(), order.end(), ElementIndex{ 0 });
  ranges::stable_sort(order, {}, [&](ElementIndex axis) { return roots.axes[axis].level; });
  std::vector<ElementIndex> place(order.size());
  std::vector<RootAxis>     sorted;
  for (ElementIndex i = 0; i < order.size(); ++i)
  {
    place[order[i]] = i;
    sorted.push_back(std::move(roots.axes[order[i]]));
  }
  for (RootAxis & axis : sorted)
  {
    axis.parent = axis.parent == kNoRoot ? kNoRoot : place[axis.parent];
    axis.stem = place[axis.stem];
  }
  for (ElementIndex & root : roots.rootOf)
  {
    root = root == kNoRoot ? kNoRoot : place[root];
  }
  roots.axes = std::move(sorted);
  return place;
}

} // namespace voxelcore
