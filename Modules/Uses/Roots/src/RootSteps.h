#pragma once
// The steps of roots from point to point, by their ends.

#include "voxelcore/Base/Library.h"
#include "voxelcore/Roots/RootHierarchy.h"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

namespace voxelcore
{

class RootSteps
{
public:
  explicit RootSteps(const RootHierarchy & roots)
  {
    for (ElementIndex axis = 0; axis < roots.axes.size(); ++axis)
    {
      const auto & points = roots.axes[axis].points;
      for (std::size_t i = 1; i < points.size(); ++i)
      {
        m_Steps.push_back({ std::minmax(points[i - 1], points[i]), axis });
      }
    }
    ranges::sort(m_Steps);
  }

  /** The first root that has a step; kNoRoot for none. */
  ElementIndex
  OwnerOf(ElementIndex a, ElementIndex b) const
  {
    const Ends ends = std::minmax(a, b);
    const auto found = ranges::lower_bound(m_Steps, std::pair(ends, ElementIndex{ 0 }));
    return found != m_Steps.end() && found->first == ends ? found->second : kNoRoot;
  }

  /** On how many roots a step is. */
  std::size_t
  Count(ElementIndex a, ElementIndex b) const
  {
    const Ends ends = std::minmax(a, b);
    return ranges::equal_range(m_Steps, ends, {}, &std::pair<Ends, ElementIndex>::first).size();
  }

  /** Of a branch, by its middle step. */
  ElementIndex
  OwnerOf(std::span<const ElementIndex> branch) const
  {
    return OwnerOf(branch[branch.size() / 2 - 1], branch[branch.size() / 2]);
  }

private:
  using Ends = std::pair<ElementIndex, ElementIndex>;

  std::vector<std::pair<Ends, ElementIndex>> m_Steps;
};

} // namespace voxelcore
