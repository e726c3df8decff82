#include "SeamChains.h"

#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

namespace voxelcore
{

namespace
{

void
SortOnce(std::vector<std::uint32_t> & numbers)
{
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

} // namespace

SeamChains::SeamChains(const MedialComplex &              core,
                       const SheetPieces &                pieces,
                       const ShortRods &                  shortRods,
                       const std::vector<std::uint32_t> & sheetOfFace,
                       double                             sliver)
  : m_Core(core)
  , m_Cells(core.cells)
  , m_Pieces(pieces)
  , m_ShortRods(shortRods)
  , m_SheetOfFace(sheetOfFace)
  , m_Sliver(sliver)
  , m_Nodes(core.cells.vertexCount)
{}

bool
SeamChains::IsSeam(ElementIndex edge) const
{
  const auto faces = m_Pieces.FacesOf(edge);
  return (m_Pieces.LiveCount(edge) > 2 || m_Pieces.IsDrawn(edge)) && m_SheetOfFace[faces.front()] != kNoPiece;
}

template <typename TVisit>
void
SeamChains::ForFaces(ElementIndex edge, TVisit && visit) const
{
  for (const ElementIndex face : m_Pieces.FacesOf(edge))
  {
    if (m_Pieces.IsLive(face))
    {
      visit(face, m_Pieces.IsStrip(face));
    }
  }
}

void
SeamChains::FindSeamEdges()
{
  std::uint32_t pieces = 0;
  for (ElementIndex face = 0; face < m_SheetOfFace.size(); ++face)
  {
    pieces = m_Pieces.IsLive(face) ? std::max(pieces, m_Pieces.OwnPiece(face) + 1) : pieces;
  }
  UnionFind                               strips(pieces);  // those that hang together
  std::vector<std::vector<std::uint32_t>> about(pieces);   // sheets
  std::vector<std::size_t>                most(pieces, 0); // of them at one edge
  for (ElementIndex edge = 0; edge < m_Cells.edges.size(); ++edge)
  {
    std::uint32_t before = kNoPiece;
    if (!IsSeam(edge))
    {
      continue;
    }
    ForFaces(edge, [&](ElementIndex face, bool isStrip) {
      if (isStrip)
      {
        strips.Unite(before == kNoPiece ? m_Pieces.OwnPiece(face) : before, m_Pieces.OwnPiece(face));
        before = m_Pieces.OwnPiece(face);
      }
    });
  }
  for (ElementIndex edge = 0; edge < m_Cells.edges.size(); ++edge)
  {
    if (!IsSeam(edge))
    {
      continue;
    }
    CurveEdge                  seam;
    std::vector<std::uint32_t> others;
    ForFaces(edge, [&](ElementIndex face, bool isStrip) {
      seam.sheets.push_back(m_SheetOfFace[face]);
      if (isStrip)
      {
        seam.strip = strips.Find(m_Pieces.OwnPiece(face));
      }
      else
      {
        others.push_back(m_SheetOfFace[face]);
      }
    });
    std::sort(seam.sheets.begin(), seam.sheets.end());
    if (seam.strip != kNoPiece)
    {
      auto & all = about[seam.strip];
      all.insert(all.end(), others.begin(), others.end());
      SortOnce(all);
      most[seam.strip] = std::max(most[seam.strip], others.size());
    }
    if (m_Pieces.IsDrawn(edge))
    {
      // Parts two sheets and is no seam; where it leads to another seam, the two are one.
      m_Nodes.Unite(m_Cells.edges[edge][0], m_Cells.edges[edge][1]);
      continue;
    }
    m_Edges[edge] = std::move(seam);
  }
  for (auto & [edge, seam] : m_Edges)
  {
    seam.key = seam.strip != kNoPiece ? about[seam.strip] : seam.sheets;
    SortOnce(seam.key);
  }
  // What one sheet goes round, and nowhere meets itself at, is a pocket in it.
  std::erase_if(m_Edges, [&](const auto & one) {
    const CurveEdge & seam = one.second;
    return seam.strip != kNoPiece && seam.key.size() == 1 && most[seam.strip] < 2;
  });
}

bool
SeamChains::HasFaces(ElementIndex vertex) const
{
  return m_FacesAt[vertex] != 0;
}

void
SeamChains::Find()
{
  m_FacesAt.assign(m_Cells.vertexCount, 0);
  for (ElementIndex face = 0; face < m_SheetOfFace.size(); ++face)
  {
    const auto corners = m_Cells.FaceVertices(face);
    for (const ElementIndex vertex : corners)
    {
      if (m_SheetOfFace[face] == kNoPiece)
      {
        m_Nodes.Unite(corners.front(), vertex);
      }
      else
      {
        ++m_FacesAt[vertex];
      }
    }
  }
  FindSeamEdges();
  for (ElementIndex edge = 0; edge < m_Cells.edges.size(); ++edge)
  {
    if (m_Pieces.FacesOf(edge).empty())
    {
      m_Edges[edge].isRod = true;
    }
  }
  RemoveShortRods();
  do
  {
    FindChains();
    GroupChains();
  } while (RemoveShortOnes());
}

bool
SeamChains::GoesOn(std::uint32_t node) const
{
  const auto & edges = m_EdgesAt.at(node);
  if (edges.size() != 2 || edges[0] == edges[1])
  {
    return false;
  }
  const CurveEdge & a = m_Edges.at(edges[0]);
  const CurveEdge & b = m_Edges.at(edges[1]);
  return a.isRod == b.isRod && a.key == b.key && a.sheets == b.sheets && (!a.isRod || !HasFaces(node));
}

void
SeamChains::FindChains()
{
  m_EdgesAt.clear();
  for (const auto & [edge, unused] : m_Edges)
  {
    for (const ElementIndex end : m_Cells.edges[edge])
    {
      m_EdgesAt[m_Nodes.Find(end)].push_back(edge);
    }
  }
  m_Chains.clear();
  std::set<ElementIndex> taken;
  const auto             walk = [&](ElementIndex first, ElementIndex from) {
    Chain        chain;
    ElementIndex edge = first;
    ElementIndex at = from;
    chain.record.isRod = m_Edges.at(first).isRod;
    chain.record.sheets = m_Edges.at(first).sheets;
    chain.record.vertices.push_back(at);
    while (taken.insert(edge).second)
    {
      const auto &       ends = m_Cells.edges[edge];
      const ElementIndex next = ends[0] ^ ends[1] ^ at;
      const double       length = m_Pieces.EdgeLength(edge) * (m_Edges.at(edge).strip == kNoPiece ? 1 : 0.5);
      chain.record.thickness += length * (m_Core.radius[at] + m_Core.radius[next]);
      chain.record.length += length;
      chain.edges.push_back(edge);
      chain.record.vertices.push_back(next);
      const std::uint32_t node = m_Nodes.Find(next);
      if (!GoesOn(node))
      {
        break;
      }
      const auto & around = m_EdgesAt.at(node);
      edge = around[0] == edge ? around[1] : around[0];
      // The next edge begins at another vertex of the node where that was drawn together.
      at = m_Nodes.Find(m_Cells.edges[edge][0]) == node ? m_Cells.edges[edge][0] : m_Cells.edges[edge][1];
      if (at != next && !taken.contains(edge))
      {
        chain.record.vertices.push_back(at);
      }
    }
    chain.record.isClosed = chain.edges.size() > 1 &&
                            m_Nodes.Find(chain.record.vertices.front()) == m_Nodes.Find(chain.record.vertices.back()) &&
                            GoesOn(m_Nodes.Find(chain.record.vertices.front()));
    if (chain.record.isClosed)
    {
      chain.record.vertices.pop_back();
    }
    chain.record.thickness = chain.record.length > 0 ? chain.record.thickness / chain.record.length
                                                                 : 2 * m_Core.radius[chain.record.vertices.front()];
    m_Chains.push_back(std::move(chain));
  };
  for (const auto & [node, edges] : m_EdgesAt)
  {
    for (const ElementIndex edge : GoesOn(node) ? std::vector<ElementIndex>() : edges)
    {
      if (!taken.contains(edge))
      {
        const auto & ends = m_Cells.edges[edge];
        walk(edge, m_Nodes.Find(ends[0]) == node ? ends[0] : ends[1]);
      }
    }
  }
  for (const auto & [edge, unused] : m_Edges)
  {
    if (!taken.contains(edge))
    {
      walk(edge, m_Cells.edges[edge][0]);
    }
  }
}

void
SeamChains::GroupChains()
{
  std::map<ElementIndex, std::uint32_t> chainOf;
  for (std::uint32_t chain = 0; chain < m_Chains.size(); ++chain)
  {
    for (const ElementIndex edge : m_Chains[chain].edges)
    {
      chainOf[edge] = chain;
    }
  }
  UnionFind  groups(m_Chains.size());
  const auto unite = [&](ElementIndex a, ElementIndex b) {
    const CurveEdge & one = m_Edges.at(a);
    const CurveEdge & other = m_Edges.at(b);
    if (!one.isRod && !other.isRod && one.key == other.key)
    {
      groups.Unite(chainOf.at(a), chainOf.at(b));
    }
  };
  for (const auto & [node, edges] : m_EdgesAt)
  {
    for (std::size_t i = 0; i < edges.size(); ++i)
    {
      for (std::size_t j = i + 1; j < edges.size(); ++j)
      {
        unite(edges[i], edges[j]);
      }
    }
  }
  std::map<std::uint32_t, ElementIndex> along;
  for (const auto & [edge, curve] : m_Edges)
  {
    if (curve.strip != kNoPiece)
    {
      unite(along.try_emplace(curve.strip, edge).first->second, edge);
    }
  }
  std::vector<std::vector<std::uint32_t>> members(m_Chains.size());
  for (std::uint32_t chain = 0; chain < m_Chains.size(); ++chain)
  {
    members[groups.Find(chain)].push_back(chain);
  }
  std::vector<Chain> grouped;
  for (auto & group : members)
  {
    if (!group.empty())
    {
      grouped.push_back(OneOf(group));
    }
  }
  m_Chains = std::move(grouped);
}

SeamChains::Chain
SeamChains::OneOf(std::vector<std::uint32_t> & group) const
{
  std::stable_sort(group.begin(), group.end(), [&](std::uint32_t a, std::uint32_t b) {
    return m_Chains[a].record.length > m_Chains[b].record.length;
  });
  Chain  one = m_Chains[group.front()];
  double thickness = one.record.thickness * one.record.length;
  for (std::size_t i = 1; i < group.size(); ++i)
  {
    const Chain & other = m_Chains[group[i]];
    one.record.length += other.record.length;
    thickness += other.record.thickness * other.record.length;
    one.record.isClosed = false;
    one.edges.insert(one.edges.end(), other.edges.begin(), other.edges.end());
  }
  one.record.thickness = one.record.length > 0 ? thickness / one.record.length : one.record.thickness;
  for (const ElementIndex edge : one.edges)
  {
    if (m_Edges.at(edge).strip != kNoPiece)
    {
      one.record.sheets = m_Edges.at(edge).key;
    }
  }
  return one;
}

void
SeamChains::Number(MedialSheets & result)
{
  // Points that stand alone.
  std::vector<std::uint8_t> used(m_Cells.vertexCount, 0);
  for (const auto & ends : m_Cells.edges)
  {
    used[ends[0]] = 1;
    used[ends[1]] = 1;
  }
  for (ElementIndex vertex = 0; vertex < used.size(); ++vertex)
  {
    if (used[vertex] == 0)
    {
      Chain chain;
      chain.record.isRod = true;
      chain.record.vertices = { vertex };
      chain.record.thickness = 2 * m_Core.radius[vertex];
      m_Chains.push_back(std::move(chain));
    }
  }
  std::stable_sort(m_Chains.begin(), m_Chains.end(), [](const Chain & a, const Chain & b) {
    return a.record.isRod != b.record.isRod ? b.record.isRod : a.record.length > b.record.length;
  });
  std::map<ElementIndex, std::uint32_t> curveOf;
  for (std::uint32_t curve = 0; curve < m_Chains.size(); ++curve)
  {
    for (const ElementIndex edge : m_Chains[curve].edges)
    {
      curveOf[edge] = curve;
    }
  }
  std::map<std::uint32_t, std::uint32_t> junctions; // by node
  const auto                             isJunction = [&](std::uint32_t node) {
    const auto & edges = m_EdgesAt.at(node);
    if (GoesOn(node))
    {
      return false;
    }
    const auto isOther = [&](ElementIndex edge) { return curveOf.at(edge) != curveOf.at(edges[0]); };
    return m_Edges.at(edges[0]).isRod ? edges.size() > 1 || HasFaces(node)
                                                                  : std::any_of(edges.begin(), edges.end(), isOther);
  };
  for (const auto & [node, unused] : m_EdgesAt)
  {
    if (isJunction(node))
    {
      junctions.emplace(node, static_cast<std::uint32_t>(junctions.size()));
      result.junctions.push_back(node);
    }
  }
  result.curveOfEdge.assign(m_Cells.edges.size(), kNoPiece);
  for (Chain & chain : m_Chains)
  {
    const auto number = static_cast<std::uint32_t>(result.curves.size());
    for (const ElementIndex edge : chain.edges)
    {
      result.curveOfEdge[edge] = number;
    }
    std::set<std::uint32_t> ends;
    for (const ElementIndex edge : chain.edges)
    {
      for (const ElementIndex vertex : m_Cells.edges[edge])
      {
        if (const auto place = junctions.find(m_Nodes.Find(vertex)); place != junctions.end())
        {
          ends.insert(place->second);
        }
      }
    }
    std::copy_n(ends.begin(), std::min<std::size_t>(2, ends.size()), chain.record.junctions.begin());
    result.curves.push_back(std::move(chain.record));
  }
}

} // namespace voxelcore
