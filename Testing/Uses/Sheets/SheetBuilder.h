#pragma once
// Surfaces of squares and lines put together by hand, and what they are cut into, counted.

#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Sheets/MedialSheets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <ostream>
#include <vector>

namespace voxelcore::testing
{

/** A complex of squares and lines over places that are welded where they are equal; every ball has one radius, unless
 *  it is said otherwise. */
class SheetBuilder
{
public:
  ElementIndex
  At(const Vector3 & place, double radius = 1)
  {
    const std::array<long, 3> key{ std::lround(place[0] * 1000),
                                   std::lround(place[1] * 1000),
                                   std::lround(place[2] * 1000) };
    const auto [entry, isNew] = m_Vertices.try_emplace(key, static_cast<ElementIndex>(m_Core.positions.size()));
    if (isNew)
    {
      m_Core.positions.push_back(place);
      m_Core.radius.push_back(radius);
      ++m_Core.cells.vertexCount;
    }
    return entry->second;
  }

  ElementIndex
  Edge(ElementIndex a, ElementIndex b)
  {
    const std::array<ElementIndex, 2> ends{ std::min(a, b), std::max(a, b) };
    const auto [entry, isNew] = m_Edges.try_emplace(ends, static_cast<ElementIndex>(m_Core.cells.edges.size()));
    if (isNew)
    {
      m_Core.cells.edges.push_back(ends);
    }
    return entry->second;
  }

  void
  Face(const std::vector<ElementIndex> & corners)
  {
    for (std::size_t i = 0; i < corners.size(); ++i)
    {
      m_Core.cells.faceVertices.push_back(corners[i]);
      m_Core.cells.faceEdges.push_back(Edge(corners[i], corners[(i + 1) % corners.size()]));
    }
    m_Core.cells.faceOffsets.push_back(m_Core.cells.faceVertices.size());
  }

  /** n x m squares from `corner` along two sides. */
  void
  Plate(const Vector3 & corner, const Vector3 & along, int n, const Vector3 & up, int m, double radius = 1)
  {
    const auto at = [&](int i, int j) { return At(AddScaled(AddScaled(corner, i, along), j, up), radius); };
    for (int i = 0; i < n; ++i)
    {
      for (int j = 0; j < m; ++j)
      {
        Face({ at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1) });
      }
    }
  }

  void
  Rod(const Vector3 & from, const Vector3 & step, int n, double radius = 1)
  {
    for (int i = 0; i < n; ++i)
    {
      Edge(At(AddScaled(from, i, step), radius), At(AddScaled(from, i + 1, step), radius));
    }
  }

  const MedialComplex &
  Core() const
  {
    return m_Core;
  }

private:
  MedialComplex                                       m_Core;
  std::map<std::array<long, 3>, ElementIndex>         m_Vertices;
  std::map<std::array<ElementIndex, 2>, ElementIndex> m_Edges;
};

struct SheetCounts
{
  std::size_t sheets = 0;
  std::size_t seams = 0;
  std::size_t rods = 0;
  std::size_t junctions = 0;

  bool
  operator==(const SheetCounts & other) const = default;
};

inline SheetCounts
CountsOf(const MedialSheets & cut)
{
  SheetCounts counts{ cut.sheets.size(), 0, 0, cut.junctions.size() };
  for (const CurveRecord & curve : cut.curves)
  {
    ++(curve.isRod ? counts.rods : counts.seams);
  }
  return counts;
}

inline std::ostream &
operator<<(std::ostream & to, const SheetCounts & counts)
{
  return to << counts.sheets << " sheets, " << counts.seams << " seams, " << counts.rods << " rods, "
            << counts.junctions << " junctions";
}

} // namespace voxelcore::testing
