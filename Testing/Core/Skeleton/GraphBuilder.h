#pragma once
// Skeleton graphs made by hand.

#include "SkeletonFixtures.h"

#include <algorithm>
#include <map>
#include <vector>

namespace voxelcore::testing
{

/** A graph of straight branches between places, with a point every mm, all of one radius per branch. */
class GraphBuilder
{
public:
  void
  Line(const Spacing3 & from, const Spacing3 & to, double radius)
  {
    const int                 steps = std::max(2, static_cast<int>(Distance(from, to) + 0.5));
    std::vector<ElementIndex> line;
    for (int i = 0; i <= steps; ++i)
    {
      const double t = static_cast<double>(i) / steps;
      line.push_back(
        Point({ from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1]), from[2] + t * (to[2] - from[2]) },
              radius));
    }
    m_Lines.push_back(line);
  }

  SkeletonGraph
  Graph()
  {
    SortBranches(m_Graph, m_Lines, true);
    return m_Graph;
  }

private:
  ElementIndex
  Point(const Spacing3 & place, double radius)
  {
    const auto [found, isNew] = m_Points.try_emplace(place, static_cast<ElementIndex>(m_Graph.positions.size()));
    if (isNew)
    {
      m_Graph.positions.push_back(place);
      m_Graph.radius.push_back(radius);
      m_Graph.erosionThickness.push_back(0);
    }
    return found->second;
  }

  SkeletonGraph                          m_Graph;
  std::vector<std::vector<ElementIndex>> m_Lines;
  std::map<Spacing3, ElementIndex>       m_Points;
};

/** A stem of 60 with two laterals, of which one has a lateral of its own. */
inline GraphBuilder
SmallRoot()
{
  GraphBuilder builder;
  builder.Line({ 0, 0, 60 }, { 0, 0, 40 }, 3);
  builder.Line({ 0, 0, 40 }, { 0, 0, 20 }, 3);
  builder.Line({ 0, 0, 20 }, { 0, 0, 0 }, 2);
  builder.Line({ 0, 0, 40 }, { 30, 0, 40 }, 1.5);
  builder.Line({ 0, 0, 20 }, { 0, 20, 20 }, 1.5);
  builder.Line({ 0, 20, 20 }, { 0, 40, 20 }, 1);
  builder.Line({ 0, 20, 20 }, { 0, 20, 10 }, 0.5);
  return builder;
}

} // namespace voxelcore::testing
