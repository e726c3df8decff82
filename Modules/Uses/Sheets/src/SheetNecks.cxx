// Sheets that hang together only within the balls of their seams are parted.

#include "SheetPieces.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace voxelcore
{

std::vector<double>
SheetPieces::WaysFromSeams(std::vector<double> & radii) const
{
  const auto &        edges = m_Core.cells.edges;
  std::vector<double> ways(m_Core.cells.vertexCount, std::numeric_limits<double>::infinity());
  radii = m_Core.radius;
  using Entry = std::pair<double, ElementIndex>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (ElementIndex edge = 0; edge < edges.size(); ++edge)
  {
    for (const ElementIndex end : edges[edge])
    {
      if (IsBorder(edge) && ways[end] > -m_Core.radius[end])
      {
        ways[end] = -m_Core.radius[end];
        queue.emplace(ways[end], end);
      }
    }
  }
  while (!queue.empty())
  {
    const auto [way, vertex] = queue.top();
    queue.pop();
    for (std::uint64_t i = m_AroundOffsets[vertex]; way == ways[vertex] && i < m_AroundOffsets[vertex + 1]; ++i)
    {
      const ElementIndex edge = m_Around[i];
      const ElementIndex other = edges[edge][0] ^ edges[edge][1] ^ vertex;
      const double       further = way + EdgeLength(edge);
      if (m_Live[edge] > 0 && further < ways[other])
      {
        ways[other] = further;
        radii[other] = radii[vertex];
        queue.emplace(further, other);
      }
    }
  }
  return ways;
}

void
SheetPieces::DrawThroughNecks(double height)
{
  const CellComplex &       cells = m_Core.cells;
  std::vector<double>       radii;
  const std::vector<double> ways = WaysFromSeams(radii);
  const auto                next = [&](ElementIndex face, auto && visit) {
    for (const ElementIndex edge : cells.FaceEdges(face))
    {
      const auto & ends = cells.edges[edge];
      for (const ElementIndex other : IsInner(edge) ? FacesOf(edge) : std::span<const ElementIndex>())
      {
        if (m_Alive[other] != 0)
        {
          visit(other, std::max(ways[ends[0]], ways[ends[1]]));
        }
      }
    }
  };
  std::vector<double> depth(cells.FaceCount(), -std::numeric_limits<double>::infinity());
  for (ElementIndex face = 0; face < cells.FaceCount(); ++face)
  {
    if (m_Alive[face] != 0)
    {
      const auto corners = cells.FaceVertices(face);
      const auto deepest = std::max_element(corners.begin(), corners.end(), [&](ElementIndex a, ElementIndex b) {
        return ways[a] < ways[b];
      });
      depth[face] = ways[*deepest];
    }
  }
  // Bodies: faces that hang together outside the balls of seams, and stand out. Only by what lies within these all
  // along they are parted, however large faces are.
  std::vector<std::uint32_t> bodyOf(cells.FaceCount(), kNoPiece);
  std::vector<char>          seen(cells.FaceCount(), 0);
  std::vector<std::uint32_t> bodiesIn(m_Pieces.size(), 0);
  std::uint32_t              bodies = 0;
  std::vector<ElementIndex>  group;
  using Entry = std::pair<double, ElementIndex>;
  std::priority_queue<Entry> queue; // the deepest first
  for (ElementIndex first = 0; first < cells.FaceCount(); ++first)
  {
    if (seen[first] != 0 || depth[first] < 0)
    {
      continue;
    }
    seen[first] = 1;
    group.assign(1, first);
    bool standsOut = false;
    for (std::size_t i = 0; i < group.size(); ++i)
    {
      for (const ElementIndex vertex : cells.FaceVertices(group[i]))
      {
        standsOut = standsOut || ways[vertex] + m_Core.radius[vertex] >= std::max(height, radii[vertex]);
      }
      next(group[i], [&](ElementIndex other, double through) {
        if (seen[other] == 0 && through >= 0)
        {
          seen[other] = 1;
          group.push_back(other);
        }
      });
    }
    if (standsOut)
    {
      ++bodiesIn[m_PieceOf[first]];
      for (const ElementIndex face : group)
      {
        bodyOf[face] = bodies;
        queue.emplace(depth[face], face);
      }
      ++bodies;
    }
  }
  // They grow together where the way to the seams is longest.
  while (!queue.empty())
  {
    const ElementIndex face = queue.top().second;
    queue.pop();
    if (bodiesIn[m_PieceOf[face]] > 1)
    {
      next(face, [&](ElementIndex other, double) {
        if (bodyOf[other] == kNoPiece)
        {
          bodyOf[other] = bodyOf[face];
          queue.emplace(depth[other], other);
        }
      });
    }
  }
  // What borders seams by less than their balls are wide is a corner of a sheet, however narrow its foot.
  std::vector<double> seamBorder(bodies, 0);
  std::vector<double> seamWidth(bodies, 0); // times length
  for (ElementIndex edge = 0; edge < cells.edges.size(); ++edge)
  {
    for (const ElementIndex face : IsBorder(edge) ? FacesOf(edge) : std::span<const ElementIndex>())
    {
      if (bodyOf[face] != kNoPiece)
      {
        const auto & ends = cells.edges[edge];
        seamBorder[bodyOf[face]] += EdgeLength(edge);
        seamWidth[bodyOf[face]] += EdgeLength(edge) * (m_Core.radius[ends[0]] + m_Core.radius[ends[1]]);
      }
    }
  }
  const auto isCorner = [&](std::uint32_t body) {
    return seamBorder[body] < height || seamBorder[body] * seamBorder[body] < seamWidth[body];
  };
  for (ElementIndex edge = 0; edge < cells.edges.size(); ++edge)
  {
    std::uint32_t one = kNoPiece;
    for (const ElementIndex face : IsInner(edge) ? FacesOf(edge) : std::span<const ElementIndex>())
    {
      if (m_Alive[face] != 0 && bodiesIn[m_PieceOf[face]] > 1 && !isCorner(bodyOf[face]))
      {
        m_Drawn[edge] = one != kNoPiece && bodyOf[face] != one ? 1 : m_Drawn[edge];
        one = bodyOf[face];
      }
    }
  }
}

} // namespace voxelcore
