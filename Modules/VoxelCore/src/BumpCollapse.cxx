#include "BumpCollapse.h"

#include <algorithm>
#include <limits>

namespace voxelcore
{

void
BumpCollapse::OfferVertex(ElementIndex vertex)
{
  // A vertex in one edge is in no face, as a face would need two edges there; so cofaces one dimension up suffice.
  if (m_VertexCofaces[vertex].count == 1)
  {
    m_Loose.push_back(vertex);
  }
}

void
BumpCollapse::RemoveLoose()
{
  // What can go at this level goes at once, end by end, while it is at hand.
  while (!m_Loose.empty())
  {
    const ElementIndex vertex = m_Loose.back();
    m_Loose.pop_back();
    if (m_VertexCofaces[vertex].count != 1 || !IsLive(vertex))
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
      m_Queue.Push({ cost, m_Core->vertexLambda[vertex], 0, vertex });
    }
  }
}

void
BumpCollapse::OfferEdge(ElementIndex edge)
{
  if (m_EdgeCofaces[edge].count == 1)
  {
    m_Queue.Push({ FaceCost(edge, m_Reached), m_Core->edgeLambda[edge], 1, edge });
  }
}

void
BumpCollapse::OfferAll()
{
  const std::size_t     edges = m_EdgeCofaces.size();
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
        if (m_EdgeCofaces[edge].count == 1)
        {
          costs[edge - first] = FaceCost(static_cast<ElementIndex>(edge), reached);
        }
      }
    }
    for (std::size_t edge = first; edge < last; ++edge)
    {
      if (m_EdgeCofaces[edge].count == 1)
      {
        m_Queue.Push({ costs[edge - first], m_Core->edgeLambda[edge], 1, static_cast<ElementIndex>(edge) });
      }
    }
  }
  for (std::size_t vertex = 0; vertex < m_VertexCofaces.size(); ++vertex)
  {
    OfferVertex(static_cast<ElementIndex>(vertex));
  }
}

void
BumpCollapse::DropEdge(ElementIndex edge)
{
  m_Bumps.edges[edge] = m_Level;
  for (const ElementIndex vertex : m_Core->cells.edges[edge])
  {
    m_VertexCofaces[vertex].Remove(edge);
    if (IsLive(vertex))
    {
      OfferVertex(vertex);
    }
  }
}

void
BumpCollapse::RemoveFace(ElementIndex edge)
{
  const ElementIndex face = m_EdgeCofaces[edge].exclusiveOr;
  for (const Reached & reached : m_Reached)
  {
    m_Vertices[reached.vertex].burnt = reached.time;
    m_Vertices[reached.vertex].witness = reached.witness;
  }
  m_Bumps.faces[face] = m_Level;
  for (const ElementIndex side : m_Core->cells.FaceEdges(face))
  {
    m_EdgeCofaces[side].Remove(face);
  }
  for (const ElementIndex side : m_Core->cells.FaceEdges(face))
  {
    if (side != edge)
    {
      OfferEdge(side);
    }
  }
  DropEdge(edge);
}

void
BumpCollapse::RemoveVertex(ElementIndex vertex)
{
  m_Bumps.vertices[vertex] = m_Level;
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
  DropEdge(m_VertexCofaces[vertex].exclusiveOr);
}

void
BumpCollapse::Fetch() const
{
  // Removing in order of cost jumps about in memory: what the pairs ahead will ask for is fetched step by step.
  const CellComplex & cells = m_Core->cells;
  const auto          faceOf = [this](const Pair * pair) {
    const bool simple = pair != nullptr && pair->isEdge && m_EdgeCofaces[pair->element].count == 1;
    return simple ? m_EdgeCofaces[pair->element].exclusiveOr : kNone;
  };
  if (const Pair * pair = m_Queue.Ahead(32); pair != nullptr && pair->isEdge)
  {
    __builtin_prefetch(&m_EdgeCofaces[pair->element], 1);
    __builtin_prefetch(&m_Bumps.edges[pair->element], 1);
    __builtin_prefetch(&cells.edges[pair->element]);
  }
  if (const ElementIndex face = faceOf(m_Queue.Ahead(24)); face != kNone)
  {
    __builtin_prefetch(&cells.faceOffsets[face]);
    __builtin_prefetch(&m_Bumps.faces[face], 1);
  }
  if (const ElementIndex face = faceOf(m_Queue.Ahead(16)); face != kNone)
  {
    __builtin_prefetch(&cells.faceEdges[cells.faceOffsets[face]]);
    __builtin_prefetch(&cells.faceVertices[cells.faceOffsets[face]]);
  }
  if (const ElementIndex face = faceOf(m_Queue.Ahead(8)); face != kNone)
  {
    for (const ElementIndex edge : cells.FaceEdges(face))
    {
      __builtin_prefetch(&m_EdgeCofaces[edge], 1);
      __builtin_prefetch(&m_Core->edgeLambda[edge]);
    }
    for (const ElementIndex vertex : cells.FaceVertices(face))
    {
      __builtin_prefetch(&m_Vertices[vertex]);
      __builtin_prefetch(&m_VertexCofaces[vertex], 1);
    }
  }
}

BumpValues
BumpCollapse::Run(const ProgressCallback & progress)
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
    Pair       pair = m_Queue.Pop();
    const bool simple = pair.isEdge ? m_Bumps.edges[pair.element] == kLive && m_EdgeCofaces[pair.element].count == 1
                                    : IsLive(pair.element) && m_VertexCofaces[pair.element].count == 1;
    if (!simple)
    {
      continue;
    }
    // Fire may have come from elsewhere since, and keepers may have gone.
    const double cost = pair.isEdge ? FaceCost(pair.element, m_Reached) : VertexCost(pair.element);
    if (cost > std::max(pair.cost, m_Level) && m_Queue.Prepare() && m_Queue.Top().cost < cost)
    {
      pair.cost = cost;
      m_Queue.Push(pair);
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
    }
    RemoveLoose();
  }
  for (auto * values : { &m_Bumps.vertices, &m_Bumps.edges, &m_Bumps.faces })
  {
    std::replace(values->begin(), values->end(), kLive, std::numeric_limits<double>::infinity());
  }
  return std::move(m_Bumps);
}

} // namespace voxelcore
