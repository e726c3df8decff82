// Seams that end just before a border or another seam are drawn on to it.

#include "SheetPieces.h"

#include "voxelcore/Base/UnionFind.h"
#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <functional>
#include <map>
#include <queue>
#include <set>
#include <utility>

namespace voxelcore
{

namespace
{

constexpr double kTip = 0.5;    ///< cosine of the greatest angle at which a seam turns back on itself
constexpr double kFlat = 0.866; ///< and of the least bend of a crease

} // namespace

void
SheetPieces::DrawSeamsOn(double reach)
{
  const auto & edges = m_Core.cells.edges;
  // What goes round an end is judged whole, not as the last lines drawn there cut it.
  m_Drawn.assign(edges.size(), 0);
  Find();
  // Seams that hang together have one number.
  UnionFind         sets(m_Core.cells.vertexCount);
  std::vector<char> onSeam(m_Core.cells.vertexCount, 0);
  for (ElementIndex edge = 0; edge < edges.size(); ++edge)
  {
    if (m_Live[edge] > 2)
    {
      sets.Unite(edges[edge][0], edges[edge][1]);
      onSeam[edges[edge][0]] = onSeam[edges[edge][1]] = 1;
    }
  }
  std::vector<std::uint32_t> chains(m_Core.cells.vertexCount, kNoPiece);
  for (ElementIndex vertex = 0; vertex < chains.size(); ++vertex)
  {
    chains[vertex] = onSeam[vertex] != 0 ? sets.Find(vertex) : kNoPiece;
  }
  std::vector<SeamEnd> ends;
  std::vector<char>    isEnd(m_Core.cells.vertexCount, 0);
  for (ElementIndex vertex = 0; vertex < chains.size(); ++vertex)
  {
    for (SeamEnd & end : EndsAt(vertex, reach))
    {
      ends.push_back(std::move(end));
      isEnd[vertex] = 1;
    }
  }
  for (const SeamEnd & end : ends)
  {
    DrawOn(end, chains, isEnd, m_Core.radius[end.vertex] + std::max(reach, m_Core.radius[end.vertex]));
  }
}

std::vector<SheetPieces::Sector>
SheetPieces::SectorsAt(ElementIndex vertex, ElementIndex seam) const
{
  const auto &        edges = m_Core.cells.edges;
  std::vector<Sector> sectors;
  for (const ElementIndex begin : FacesOf(seam))
  {
    Sector       sector{ begin, begin, {}, kNoPiece };
    ElementIndex face = m_Alive[begin] != 0 ? begin : kNoPiece;
    ElementIndex from = seam;
    while (face != kNoPiece)
    {
      ElementIndex edge = kNoPiece;
      for (const ElementIndex one : m_Core.cells.FaceEdges(face))
      {
        if (one != from && (edges[one][0] == vertex || edges[one][1] == vertex))
        {
          edge = one;
        }
      }
      sector.last = edge;
      sector.end = face;
      if (edge == kNoPiece || edge == seam || m_Live[edge] != 2)
      {
        break;
      }
      sector.edges.push_back(edge);
      ElementIndex other = kNoPiece;
      for (const ElementIndex one : FacesOf(edge))
      {
        other = m_Alive[one] != 0 && one != face ? one : other;
      }
      from = edge;
      face = other;
    }
    if (sector.last != kNoPiece)
    {
      sectors.push_back(std::move(sector));
    }
  }
  return sectors;
}

std::vector<ElementIndex>
SheetPieces::SeamsAt(ElementIndex vertex) const
{
  std::vector<ElementIndex> seams;
  for (std::uint64_t i = m_AroundOffsets[vertex]; i < m_AroundOffsets[vertex + 1]; ++i)
  {
    if (m_Live[m_Around[i]] > 2)
    {
      seams.push_back(m_Around[i]);
    }
  }
  return seams;
}

std::vector<SheetPieces::SeamEnd>
SheetPieces::EndsAt(ElementIndex vertex, double reach) const
{
  const std::vector<ElementIndex> seams = SeamsAt(vertex);
  std::vector<SeamEnd>            ends;
  for (const ElementIndex seam : seams)
  {
    for (Sector & sector : SectorsAt(vertex, seam))
    {
      // Came back; the other way round it does, too. Where four walls end two and two go round.
      if (sector.last == seam && sector.begin < sector.end && !sector.edges.empty())
      {
        ends.push_back({ vertex, std::move(sector.edges) });
      }
    }
  }
  if (seams.size() != 2 || !ends.empty())
  {
    return ends;
  }
  // Tips may be blunt.
  const auto along = [&](ElementIndex edge) {
    ElementIndex at = vertex;
    double       length = 0;
    for (bool goesOn = true; goesOn;)
    {
      at = m_Core.cells.edges[edge][0] ^ m_Core.cells.edges[edge][1] ^ at;
      length += EdgeLength(edge);
      const auto next = SeamsAt(at);
      goesOn = length < std::max(reach, m_Core.radius[vertex]) && next.size() == 2 && at != vertex;
      edge = goesOn ? next[next[0] == edge ? 1 : 0] : edge;
    }
    return Minus(m_Core.positions[at], m_Core.positions[vertex]);
  };
  const Vector3 one = along(seams[0]);
  const Vector3 other = along(seams[1]);
  if (Dot(one, other) < kTip * Length(one) * Length(other))
  {
    return ends;
  }
  bool isTip = false;
  for (const Sector & sector : SectorsAt(vertex, seams[0]))
  {
    if (sector.last != seams[1])
    {
      continue;
    }
    const bool isStrip = IsSliver(m_Pieces[m_PieceOf[sector.begin]], reach);
    isTip = isTip || isStrip;
    // A sheet that goes round a strip's tip has a crease there; about a pocket it is flat.
    const Vector3 first = Cross(one, Inwards(sector.begin, seams[0]));
    const Vector3 second = Cross(Inwards(sector.end, seams[1]), other);
    const bool    isFlat = Dot(first, second) > kFlat * Length(first) * Length(second);
    if (!isStrip && !isFlat && !sector.edges.empty())
    {
      ends.push_back({ vertex, sector.edges });
    }
  }
  return isTip && ends.size() > 1 ? ends : std::vector<SeamEnd>();
}

std::set<ElementIndex>
SheetPieces::NearAlongSeams(ElementIndex from, double reach) const
{
  using Entry = std::pair<double, ElementIndex>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  std::set<ElementIndex>                                         near;
  queue.emplace(0, from);
  while (!queue.empty())
  {
    const auto [way, vertex] = queue.top();
    queue.pop();
    for (const ElementIndex edge : near.insert(vertex).second ? SeamsAt(vertex) : std::vector<ElementIndex>())
    {
      if (way + EdgeLength(edge) < reach)
      {
        queue.emplace(way + EdgeLength(edge), m_Core.cells.edges[edge][0] ^ m_Core.cells.edges[edge][1] ^ vertex);
      }
    }
  }
  return near;
}

void
SheetPieces::DrawOn(const SeamEnd &                    from,
                    const std::vector<std::uint32_t> & chains,
                    const std::vector<char> &          isEnd,
                    double                             reach)
{
  const auto &                                            edges = m_Core.cells.edges;
  const ElementIndex                                      end = from.vertex;
  std::map<ElementIndex, std::pair<double, ElementIndex>> reached; // way, and the edge it came by
  using Entry = std::pair<double, ElementIndex>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  // Both ends of a strip are no gap in its seam.
  const std::set<ElementIndex> near = NearAlongSeams(end, 2 * reach);
  const auto                   go = [&](ElementIndex vertex, double way, ElementIndex edge) {
    const ElementIndex other = edges[edge][0] ^ edges[edge][1] ^ vertex;
    // Where a fin stood, the surface itself says how the seam went on.
    const double further = way + (FacesOf(edge).size() > 2 ? 0 : EdgeLength(edge));
    const auto   place = reached.find(other);
    if (further < reach && other != end && (place == reached.end() || further < place->second.first))
    {
      reached[other] = { further, edge };
      queue.emplace(further, other);
    }
  };
  for (const ElementIndex edge : from.ways)
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
    const bool isOnSeam = chains[vertex] != kNoPiece;
    const bool isTarget = isRim || (isOnSeam && (chains[vertex] != chains[end] || isEnd[vertex] != 0));
    if (isTarget && !near.contains(vertex))
    {
      for (ElementIndex at = vertex; at != end;)
      {
        const ElementIndex edge = reached[at].second;
        m_Drawn[edge] = 1;
        at = edges[edge][0] ^ edges[edge][1] ^ at;
      }
      return;
    }
    if (isOnSeam)
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
