#include "ToleranceCollapse.h"

#include <algorithm>
#include <limits>

namespace voxelcore
{

void
ToleranceCollapse::OfferVertex(ElementIndex vertex)
{
  // A vertex in one edge is in no face, as a face would need two edges there; so cofaces one dimension up suffice.
  if (m_VertexStanding[vertex].IsFree())
  {
    m_Loose.push_back(vertex);
  }
}

void
ToleranceCollapse::RemoveLoose()
{
  // What can go at this level goes at once, end by end, while it is at hand.
  while (!m_Loose.empty())
  {
    const ElementIndex vertex = m_Loose.back();
    m_Loose.pop_back();
    if (!m_VertexStanding[vertex].IsFree())
    {
      continue;
    }
    const double cost = VertexCost(vertex);
    if (cost <= m_Level)
    {
      RemoveVertex(vertex);
    }
    else
    {
      m_Queue.Push({ cost, 0, vertex });
    }
  }
}

void
ToleranceCollapse::OfferEdges(std::span<const ElementIndex> edges)
{
  for (const ElementIndex edge : edges)
  {
    m_Queue.Push({ FaceCost(edge, m_Reached), 1, edge });
  }
}

void
ToleranceCollapse::OfferAll()
{
  const std::size_t     edges = m_EdgeStanding.size();
  constexpr std::size_t chunk = std::size_t{ 1 } << 16; // what is computed side by side waits here for its turn
  std::vector<double>   costs(std::min(edges, chunk));
  for (std::size_t first = 0; first < edges; first += chunk)
  {
    const std::size_t last = std::min(edges, first + chunk);
#pragma omp parallel if (last - first > 4096)
    {
      std::vector<Reached> reached;
#pragma omp for schedule(static)
      for (std::size_t edge = first; edge < last; ++edge)
      {
        if (const std::size_t ahead = edge + 12; ahead < edges && m_EdgeStanding[ahead].IsFree())
        {
          FetchFace(m_EdgeStanding[ahead].Coface());
        }
        if (m_EdgeStanding[edge].IsFree())
        {
          costs[edge - first] = FaceCost(static_cast<ElementIndex>(edge), reached);
        }
      }
    }
    for (std::size_t edge = first; edge < last; ++edge)
    {
      if (m_EdgeStanding[edge].IsFree())
      {
        m_Queue.Push({ costs[edge - first], 1, static_cast<ElementIndex>(edge) });
      }
    }
  }
  for (std::size_t vertex = 0; vertex < m_VertexStanding.size(); ++vertex)
  {
    OfferVertex(static_cast<ElementIndex>(vertex));
  }
}

void
ToleranceCollapse::DropEdge(ElementIndex edge)
{
  m_EdgeStanding[edge].Go(m_Level);
  for (const ElementIndex vertex : m_Core->cells.edges[edge])
  {
    if (IsLive(vertex))
    {
      m_VertexStanding[vertex].Remove(edge);
      OfferVertex(vertex);
    }
  }
}

void
ToleranceCollapse::RemoveFace(ElementIndex edge)
{
  const CellComplex & cells = m_Core->cells;
  const ElementIndex  face = m_EdgeStanding[edge].Coface();
  for (const Reached & reached : m_Reached)
  {
    m_Vertices[reached.vertex].burnt = reached.time;
    m_Vertices[reached.vertex].witness = reached.witness;
  }
  m_FaceTolerances[face] = m_Level;
  // What the faces behind will ask for is fetched in three steps, with other work between them.
  m_Freed.clear();
  for (const ElementIndex side : cells.FaceEdges(face))
  {
    m_EdgeStanding[side].Remove(face);
    if (side != edge && m_EdgeStanding[side].IsFree())
    {
      m_Freed.push_back(side);
      __builtin_prefetch(&cells.faceOffsets[m_EdgeStanding[side].Coface()]);
    }
  }
  DropEdge(edge);
  for (const ElementIndex side : m_Freed)
  {
    const std::uint64_t first = cells.faceOffsets[m_EdgeStanding[side].Coface()];
    __builtin_prefetch(&cells.faceVertices[first]);
    __builtin_prefetch(&cells.faceEdges[first]);
  }
  RemoveLoose();
  for (const ElementIndex side : m_Freed)
  {
    FetchFace(m_EdgeStanding[side].Coface());
  }
  OfferEdges(m_Freed);
}

void
ToleranceCollapse::RemoveVertex(ElementIndex vertex)
{
  const ElementIndex edge = m_VertexStanding[vertex].Coface();
  m_VertexStanding[vertex].Go(m_Level);
  if (m_ToHeir)
  {
    HandOver(vertex, m_Heir, m_HeirGap);
  }
  else
  {
    std::uint32_t point = m_NextKept[m_Vertices[vertex].lastKept];
    for (const Home & home : m_NewHomes)
    {
      const std::uint32_t next = m_NextKept[point];
      Keep(home.vertex, point, home.gap);
      point = next;
    }
  }
  DropEdge(edge);
}

void
ToleranceCollapse::FetchFace(ElementIndex face) const
{
  const CellComplex & cells = m_Core->cells;
  for (const ElementIndex edge : cells.FaceEdges(face))
  {
    __builtin_prefetch(&m_EdgeStanding[edge], 1);
  }
  for (const ElementIndex vertex : cells.FaceVertices(face))
  {
    __builtin_prefetch(&m_Vertices[vertex], 1);
  }
}

void
ToleranceCollapse::Fetch() const
{
  // Removing in order of cost jumps about in memory: what the pairs ahead will ask for is fetched step by step.
  const CellComplex & cells = m_Core->cells;
  const auto          faceOf = [this](const Pair * pair) {
    const bool simple = pair != nullptr && pair->isEdge && m_EdgeStanding[pair->element].IsFree();
    return simple ? m_EdgeStanding[pair->element].Coface() : kNone;
  };
  if (const Pair * pair = m_Queue.Ahead(32); pair != nullptr && pair->isEdge)
  {
    __builtin_prefetch(&m_EdgeStanding[pair->element], 1);
    __builtin_prefetch(&cells.edges[pair->element]);
  }
  if (const ElementIndex face = faceOf(m_Queue.Ahead(24)); face != kNone)
  {
    __builtin_prefetch(&cells.faceOffsets[face]);
    __builtin_prefetch(&m_FaceTolerances[face], 1);
  }
  if (const ElementIndex face = faceOf(m_Queue.Ahead(16)); face != kNone)
  {
    __builtin_prefetch(&cells.faceEdges[cells.faceOffsets[face]]);
    __builtin_prefetch(&cells.faceVertices[cells.faceOffsets[face]]);
  }
  if (const ElementIndex face = faceOf(m_Queue.Ahead(8)); face != kNone)
  {
    FetchFace(face);
    for (const ElementIndex vertex : cells.FaceVertices(face))
    {
      __builtin_prefetch(&m_VertexStanding[vertex], 1);
    }
  }
  if (const Pair * pair = m_Queue.Ahead(4); faceOf(pair) != kNone)
  {
    for (const ElementIndex end : cells.edges[pair->element])
    {
      __builtin_prefetch(&m_Vertices[m_Vertices[end].witness]);
    }
  }
}

ToleranceValues
ToleranceCollapse::Run(const ProgressCallback & progress)
{
  OfferAll();
  RemoveLoose();
  std::size_t count = 0;
  while (m_Queue.Prepare())
  {
    if ((count++ & 0xFFFFU) == 0)
    {
      ReportProgress(progress, "prune", 0.0);
    }
    Fetch();
    const Pair pair = m_Queue.Pop();
    const bool simple = pair.isEdge ? m_EdgeStanding[pair.element].IsFree() : m_VertexStanding[pair.element].IsFree();
    if (!simple)
    {
      continue;
    }
    // Fire may have come from elsewhere since, and keepers may have gone.
    const double cost = pair.isEdge ? FaceCost(pair.element, m_Reached) : VertexCost(pair.element);
    if (cost > std::max(pair.cost, m_Level) && m_Queue.Prepare() && m_Queue.Top().cost < cost)
    {
      m_Queue.Push({ cost, pair.isEdge, pair.element });
      continue;
    }
    m_Level = std::max(m_Level, cost);
    if (pair.isEdge)
    {
      RemoveFace(pair.element);
    }
    else
    {
      RemoveVertex(pair.element);
      RemoveLoose();
    }
  }
  return TakeTolerances();
}

ToleranceValues
ToleranceCollapse::TakeTolerances()
{
  // What is no longer needed makes room.
  std::vector<Vertex>().swap(m_Vertices);
  std::vector<ElementIndex>().swap(m_Neighbours);
  const auto take = [](std::vector<RemainingElements> & standing) {
    std::vector<double> heights;
    heights.reserve(standing.size());
    for (const RemainingElements & one : standing)
    {
      heights.push_back(one.IsLive() ? std::numeric_limits<double>::infinity() : one.Height());
    }
    std::vector<RemainingElements>().swap(standing);
    return heights;
  };
  ToleranceValues values;
  values.vertices = take(m_VertexStanding);
  values.edges = take(m_EdgeStanding);
  values.faces = std::move(m_FaceTolerances);
  return values;
}

} // namespace voxelcore
