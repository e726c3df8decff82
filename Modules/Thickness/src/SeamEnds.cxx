// Seams that end just before a border or another seam are drawn on to it.

#include "SheetPieces.h"

#include "voxelcore/UnionFind.h"

#include <algorithm>
#include <functional>
#include <map>
#include <queue>
#include <utility>

namespace voxelcore
{

void
SheetPieces::DrawSeamsOn(double reach)
{
  const auto & edges = m_Core.cells.edges;
  // Seams that hang together have one number.
  UnionFind                  sets(m_Core.cells.vertexCount);
  std::vector<std::uint32_t> seams(m_Core.cells.vertexCount,
                                   0); ///< edges of seams at a vertex
  for (ElementIndex edge = 0; edge < edges.size(); ++edge)
  {
    if (m_Live[edge] > 2)
    {
      sets.Unite(edges[edge][0], edges[edge][1]);
      ++seams[edges[edge][0]];
      ++seams[edges[edge][1]];
    }
  }
  std::vector<std::uint32_t> chains(m_Core.cells.vertexCount, kNoPiece);
  for (ElementIndex vertex = 0; vertex < chains.size(); ++vertex)
  {
    chains[vertex] = seams[vertex] > 0 ? sets.Find(vertex) : kNoPiece;
  }
  for (ElementIndex edge = 0; edge < edges.size(); ++edge)
  {
    for (const ElementIndex end : edges[edge])
    {
      if (m_Live[edge] > 2 && seams[end] == 1)
      {
        DrawOn(end, edge, chains, reach + m_Core.radius[end]);
      }
    }
  }
}

void
SheetPieces::DrawOn(ElementIndex end, ElementIndex seam, const std::vector<std::uint32_t> & chains, double reach)
{
  const auto & edges = m_Core.cells.edges;
  // The edges at the end that lie between two of the seam's faces, round it.
  std::vector<ElementIndex> first;
  for (const ElementIndex begin : FacesOf(seam))
  {
    std::vector<ElementIndex> passed;
    ElementIndex              face = m_Alive[begin] != 0 ? begin : kNoPiece;
    ElementIndex              from = seam;
    while (face != kNoPiece)
    {
      ElementIndex edge = kNoPiece;
      for (const ElementIndex one : m_Core.cells.FaceEdges(face))
      {
        if (one != from && (edges[one][0] == end || edges[one][1] == end))
        {
          edge = one;
        }
      }
      if (edge == seam)
      {
        first.insert(first.end(), passed.begin(),
                     passed.end()); // came back: what it passed lies between
        break;
      }
      if (edge == kNoPiece || m_Live[edge] != 2)
      {
        break;
      }
      passed.push_back(edge);
      ElementIndex other = kNoPiece;
      for (const ElementIndex one : FacesOf(edge))
      {
        other = m_Alive[one] != 0 && one != face ? one : other;
      }
      from = edge;
      face = other;
    }
  }
  std::map<ElementIndex, std::pair<double, ElementIndex>> reached; // way, and the edge it came by
  using Entry = std::pair<double, ElementIndex>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const auto go = [&](ElementIndex from, double way, ElementIndex edge) {
    const ElementIndex other = edges[edge][0] ^ edges[edge][1] ^ from;
    const double       further = way + EdgeLength(edge);
    const auto         place = reached.find(other);
    if (further < reach && other != end && (place == reached.end() || further < place->second.first))
    {
      reached[other] = { further, edge };
      queue.emplace(further, other);
    }
  };
  for (const ElementIndex edge : first)
  {
    go(end, 0, edge);
  }
  while (!queue.empty())
  {
    const auto [way, vertex] = queue.top();
    queue.pop();
    if (way > reached[vertex].first)
    {
      continue;
    }
    const std::span<const ElementIndex> around{ m_Around.data() + m_AroundOffsets[vertex],
                                                m_Around.data() + m_AroundOffsets[vertex + 1] };
    const bool isRim = std::any_of(around.begin(), around.end(), [&](ElementIndex edge) { return m_Live[edge] == 1; });
    if (isRim || (chains[vertex] != kNoPiece && chains[vertex] != chains[end]))
    {
      for (ElementIndex at = vertex; at != end;)
      {
        const ElementIndex edge = reached[at].second;
        m_Drawn[edge] = 1;
        at = edges[edge][0] ^ edges[edge][1] ^ at;
      }
      return;
    }
    if (chains[vertex] == chains[end])
    {
      continue;
    }
    for (const ElementIndex edge : around)
    {
      if (m_Live[edge] == 2)
      {
        go(vertex, way, edge);
      }
    }
  }
}

} // namespace voxelcore
