// Rods and seams that are too short to be told from what they hang on or join.

#include "SeamChains.h"

#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <set>

namespace voxelcore
{

void
SeamChains::RemoveShortRods()
{
  std::vector<char> isOnFlake(m_Cells.vertexCount, 0);
  for (ElementIndex face = 0; face < m_SheetOfFace.size(); ++face)
  {
    for (const ElementIndex vertex :
         m_SheetOfFace[face] == kNoPiece ? m_Cells.FaceVertices(face) : std::span<const ElementIndex>())
    {
      isOnFlake[vertex] = 1;
    }
  }
  const auto &            edges = m_ShortRods.Edges();
  const auto &            nets = m_ShortRods.NetsOfEdges();
  std::set<std::uint32_t> onFlakes;
  for (std::size_t i = 0; i < edges.size(); ++i)
  {
    const auto & ends = m_Cells.edges[edges[i]];
    if (isOnFlake[ends[0]] != 0 || isOnFlake[ends[1]] != 0)
    {
      onFlakes.insert(nets[i]);
    }
  }
  for (std::size_t i = 0; i < edges.size(); ++i)
  {
    if (onFlakes.contains(nets[i]))
    {
      DrawTogether({ {}, { edges[i] } });
    }
    m_Edges.erase(edges[i]);
  }
}

bool
SeamChains::IsSpur(const CurveRecord & rod)
{
  const std::array<ElementIndex, 2> ends{ rod.vertices.front(), rod.vertices.back() };
  for (std::size_t foot = 0; foot < 2 && rod.isRod; ++foot)
  {
    const ElementIndex tip = ends[1 - foot];
    // Of rods that meet alone two stay, so that nothing goes altogether.
    const std::uint32_t node = m_Nodes.Find(ends[foot]);
    const bool          hangs = HasFaces(ends[foot]) || m_EdgesAt.at(node).size() - m_Gone[node] > 2;
    if (hangs && !HasFaces(tip) && m_EdgesAt.at(m_Nodes.Find(tip)).size() == 1)
    {
      double standOut = 0;
      for (const ElementIndex vertex : rod.vertices)
      {
        standOut = std::max(standOut,
                            Distance(m_Core.positions[ends[foot]], m_Core.positions[vertex]) + m_Core.radius[vertex] -
                              m_Core.radius[ends[foot]]);
      }
      if (standOut >= std::max(m_Sliver, rod.thickness))
      {
        return false;
      }
      ++m_Gone[node];
      return true;
    }
  }
  return false;
}

bool
SeamChains::IsPatch(const Chain & chain)
{
  const std::set<ElementIndex> own(chain.edges.begin(), chain.edges.end());
  std::set<std::uint32_t>      nodes;
  for (const ElementIndex edge : chain.edges)
  {
    if (m_Edges.at(edge).strip == kNoPiece)
    {
      return false;
    }
    nodes.insert(m_Nodes.Find(m_Cells.edges[edge][0]));
    nodes.insert(m_Nodes.Find(m_Cells.edges[edge][1]));
  }
  std::ptrdiff_t ends = 0;
  for (const std::uint32_t node : nodes)
  {
    const auto & edges = m_EdgesAt.at(node);
    ends += std::count_if(edges.begin(), edges.end(), [&](ElementIndex edge) { return !own.contains(edge); });
  }
  return ends > 2;
}

bool
SeamChains::IsJunction(const Chain & chain)
{
  const CurveRecord & curve = chain.record;
  // Round a patch its border, twice the length, goes like the girth of a ball.
  const double wide = curve.thickness * (!curve.isRod && IsPatch(chain) ? std::numbers::pi / 2 : 1);
  if (curve.length >= std::max(m_Sliver, wide))
  {
    return false;
  }
  if (!curve.isRod)
  {
    return true;
  }
  const std::uint32_t a = m_Nodes.Find(curve.vertices.front());
  const std::uint32_t b = m_Nodes.Find(curve.vertices.back());
  const auto          isEnd = [&](std::uint32_t node) { return !HasFaces(node) && m_EdgesAt.at(node).size() == 1; };
  return a != b && !isEnd(a) && !isEnd(b) && !(HasFaces(a) && HasFaces(b));
}

void
SeamChains::DrawTogether(const Chain & chain)
{
  for (const ElementIndex edge : chain.edges)
  {
    const std::uint32_t a = m_Nodes.Find(m_Cells.edges[edge][0]);
    const std::uint32_t b = m_Nodes.Find(m_Cells.edges[edge][1]);
    m_Nodes.Unite(a, b);
    m_FacesAt[m_Nodes.Find(a)] = std::max(m_FacesAt[a], m_FacesAt[b]);
    m_Edges.erase(edge);
  }
}

bool
SeamChains::RemoveShortOnes()
{
  bool changed = false;
  m_Gone.clear();
  std::vector<const Chain *> rods;
  for (const Chain & chain : m_Chains)
  {
    if (IsSpur(chain.record))
    {
      changed = true;
      for (const ElementIndex edge : chain.edges)
      {
        m_Edges.erase(edge);
      }
    }
    else if (IsJunction(chain))
    {
      chain.record.isRod ? rods.push_back(&chain) : DrawTogether(chain);
      changed = changed || !chain.record.isRod;
    }
  }
  // The shortest first, and of those that meet one at a time: what they were between may be another then.
  std::stable_sort(rods.begin(), rods.end(), [](const Chain * a, const Chain * b) {
    return a->record.length < b->record.length;
  });
  std::set<std::uint32_t> touched;
  for (const Chain * rod : rods)
  {
    const std::uint32_t a = m_Nodes.Find(rod->record.vertices.front());
    const std::uint32_t b = m_Nodes.Find(rod->record.vertices.back());
    const auto          isNew = [&](std::uint32_t node) { return !touched.contains(node) && m_Gone[node] == 0; };
    if (a != b && isNew(a) && isNew(b))
    {
      changed = true;
      DrawTogether(*rod);
      touched.insert(m_Nodes.Find(a));
    }
  }
  return changed;
}

} // namespace voxelcore
