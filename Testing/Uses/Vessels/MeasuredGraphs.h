#pragma once
// Skeletons given by their points.

#include "voxelcore/Skeleton/BranchTable.h"
#include "voxelcore/Skeleton/MeasuredSkeleton.h"

#include <cmath>
#include <vector>

namespace voxelcore::testing
{

/** A graph that is built point by point. */
class GraphOfLines
{
public:
  ElementIndex
  Point(const Vector3 & place, double radius)
  {
    m_Part.graph.positions.push_back(place);
    m_Part.graph.radius.push_back(radius);
    return static_cast<ElementIndex>(m_Part.graph.radius.size() - 1);
  }

  /** A straight line of so many pieces, radius linear. */
  void
  Line(ElementIndex from, ElementIndex to, int pieces)
  {
    std::vector<ElementIndex> line{ from };
    for (int piece = 1; piece < pieces; ++piece)
    {
      const double t = static_cast<double>(piece) / pieces;
      Vector3      place{};
      for (std::size_t k = 0; k < 3; ++k)
      {
        place[k] = (1 - t) * m_Part.graph.positions[from][k] + t * m_Part.graph.positions[to][k];
      }
      line.push_back(Point(place, (1 - t) * m_Part.graph.radius[from] + t * m_Part.graph.radius[to]));
    }
    line.push_back(to);
    m_Lines.push_back(line);
  }

  MeasuredSkeleton
  Measured(std::int64_t label = 1)
  {
    SortBranches(m_Part.graph, m_Lines, true);
    m_Part.table = MeasureBranches(m_Part.graph);
    m_Part.label = label;
    return m_Part;
  }

private:
  MeasuredSkeleton                       m_Part;
  std::vector<std::vector<ElementIndex>> m_Lines;
};

} // namespace voxelcore::testing
