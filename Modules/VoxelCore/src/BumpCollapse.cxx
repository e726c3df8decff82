#include "BumpCollapse.h"

#include "voxelcore/SimplePairCollapse.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

namespace voxelcore
{

namespace
{

constexpr double        kInfinity = std::numeric_limits<double>::infinity();
constexpr std::uint32_t kNone = 0xFFFFFFFFU;

// How far uphill a keeper is looked for. A spur of noise in a thick part has a hump here and there at which the next
// ball in is no better than it; those further in are.
constexpr int kUphillSteps = 32;

// When long lists become shorter: so many looks at a boundary vertex, on the average.
constexpr std::size_t kLooks = 12;
constexpr std::size_t kShortList = 32;
constexpr double      kLeastReserve = std::numeric_limits<double>::min(); // more than none

// Fire costs that much more than what sticks out. Sheets stop a little before the balls at their rims are used up, so
// that the loose edges a burnt face leaves behind still find keepers; without it sheets grow hair along their rims.
constexpr double kMargin = 1.25;

} // namespace

BumpCollapse::BumpCollapse(const MedialComplex &             core,
                           const SpacingWeights &            weights,
                           const std::vector<LatticePoint> & points,
                           const std::vector<ElementIndex> & touching,
                           double                            floor,
                           const ProgressCallback &          progress)
  : m_Core(&core)
  , m_Points(&points)
  , m_Scale{ weights.unit * static_cast<double>(weights.weight[0]),
             weights.unit * static_cast<double>(weights.weight[1]),
             weights.unit * static_cast<double>(weights.weight[2]) }
  , m_Bumps{ std::vector<double>(core.cells.vertexCount, kLive),
             std::vector<double>(core.cells.edges.size(), kLive),
             std::vector<double>(core.cells.FaceCount(), kLive) }
  , m_VertexCofaces(core.cells.vertexCount)
  , m_EdgeCofaces(core.cells.edges.size())
  , m_Witness(core.cells.vertexCount)
  , m_Burnt(core.cells.vertexCount, 0.0)
  , m_LastKept(core.cells.vertexCount, kNone)
  , m_NextKept(points.size())
  , m_Reserve(core.cells.vertexCount, 0.0)
{
  if (floor > 0)
  {
    DropBelow(floor, progress);
  }
  CountCofaces();
  m_Balls.reserve(core.cells.vertexCount);
  for (std::size_t vertex = 0; vertex < core.cells.vertexCount; ++vertex)
  {
    const auto & p = core.positions[vertex];
    m_Balls.push_back({ { m_Scale[0] * p[0], m_Scale[1] * p[1], m_Scale[2] * p[2] }, core.radius[vertex] });
  }
  std::iota(m_Witness.begin(), m_Witness.end(), ElementIndex{ 0 });
  for (std::uint32_t point = 0; point < points.size(); ++point)
  {
    if (IsLive(touching[point]))
    {
      Keep(touching[point], point);
    }
  }
  FindNeighbours();
}

void
BumpCollapse::DropBelow(double floor, const ProgressCallback & progress)
{
  SimplePairCollapse collapse(m_Core->cells, m_Core->vertexLambda, m_Core->edgeLambda, m_Core->faceLambda);
  collapse.CollapseBelow(floor, progress);
  const auto drop = [](const std::vector<std::uint8_t> & live, std::vector<double> & values) {
    for (std::size_t element = 0; element < live.size(); ++element)
    {
      values[element] = live[element] != 0 ? kLive : kBelowFloor;
    }
  };
  drop(collapse.Live().vertices, m_Bumps.vertices);
  drop(collapse.Live().edges, m_Bumps.edges);
  drop(collapse.Live().faces, m_Bumps.faces);
}

void
BumpCollapse::CountCofaces()
{
  const CellComplex & cells = m_Core->cells;
  for (std::size_t edge = 0; edge < cells.edges.size(); ++edge)
  {
    for (const ElementIndex vertex : cells.edges[edge])
    {
      m_VertexCofaces[vertex].count += m_Bumps.edges[edge] == kLive ? 1 : 0;
      m_VertexCofaces[vertex].exclusiveOr ^= m_Bumps.edges[edge] == kLive ? static_cast<ElementIndex>(edge) : 0;
    }
  }
  for (std::size_t face = 0; face < cells.FaceCount(); ++face)
  {
    for (const ElementIndex edge : cells.FaceEdges(face))
    {
      m_EdgeCofaces[edge].count += m_Bumps.faces[face] == kLive ? 1 : 0;
      m_EdgeCofaces[edge].exclusiveOr ^= m_Bumps.faces[face] == kLive ? static_cast<ElementIndex>(face) : 0;
    }
  }
}

void
BumpCollapse::FindNeighbours()
{
  const CellComplex & cells = m_Core->cells;
  m_NeighbourStart.assign(cells.vertexCount + 1, 0);
  for (std::size_t vertex = 0; vertex < cells.vertexCount; ++vertex)
  {
    m_NeighbourStart[vertex + 1] = m_NeighbourStart[vertex] + m_VertexCofaces[vertex].count;
  }
  m_Neighbours.resize(m_NeighbourStart.back());
  std::vector<std::uint32_t> filled(m_NeighbourStart.begin(), m_NeighbourStart.end() - (cells.vertexCount > 0 ? 1 : 0));
  for (std::size_t edge = 0; edge < cells.edges.size(); ++edge)
  {
    if (m_Bumps.edges[edge] == kLive)
    {
      const auto & [a, b] = cells.edges[edge];
      m_Neighbours[filled[a]++] = b;
      m_Neighbours[filled[b]++] = a;
    }
  }
  m_Uphill.resize(cells.vertexCount);
  for (ElementIndex vertex = 0; vertex < cells.vertexCount; ++vertex)
  {
    ElementIndex best = vertex;
    double       steepest = 0;
    for (std::uint32_t i = m_NeighbourStart[vertex]; i < m_NeighbourStart[vertex + 1]; ++i)
    {
      const ElementIndex other = m_Neighbours[i];
      const double       rise = m_Core->radius[other] - m_Core->radius[vertex];
      if (rise <= 0)
      {
        continue;
      }
      // Protrusion is distance minus rise.
      const double slope = rise / (Protrusion(vertex, other) + rise);
      if (slope > steepest)
      {
        steepest = slope;
        best = other;
      }
    }
    m_Uphill[vertex] = best;
  }
}

void
BumpCollapse::Keep(ElementIndex vertex, std::uint32_t point)
{
  std::uint32_t & last = m_LastKept[vertex];
  if (last == kNone)
  {
    m_NextKept[point] = point;
  }
  else
  {
    m_NextKept[point] = m_NextKept[last];
    m_NextKept[last] = point;
  }
  last = point;
}

double
BumpCollapse::FaceCost(ElementIndex edge)
{
  const CellComplex & cells = m_Core->cells;
  const ElementIndex  face = m_EdgeCofaces[edge].exclusiveOr;
  const auto          corners = cells.FaceVertices(face);
  const auto          sides = cells.FaceEdges(face);
  const auto [a, c] = cells.edges[edge];
  double cost = std::max(m_Burnt[a], m_Burnt[c]);
  m_Reached.clear();
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const ElementIndex w = corners[i];
    if (w == a || w == c)
    {
      continue;
    }
    // The witness must not stick out, and neither must the end that fire comes from: else fire that came in along one
    // sheet would run out again along the next one, towards balls beside its witness.
    const double fromA = std::max(Protrusion(m_Witness[a], w), Protrusion(a, w));
    const double fromC = std::max(Protrusion(m_Witness[c], w), Protrusion(c, w));
    const double across = std::max(kMargin * std::min(fromA, fromC), m_Burnt[w]);
    // Sides i - 1 and i meet at corner i. Where one of them is free, fire comes from there too, and the two meet.
    const ElementIndex before = sides[i == 0 ? sides.size() - 1 : i - 1];
    if (m_EdgeCofaces[before].count == 1 || m_EdgeCofaces[sides[i]].count == 1)
    {
      cost = std::max(cost, (m_Burnt[w] + across) / 2);
    }
    else
    {
      cost = std::max(cost, across);
      m_Reached.push_back({ w, fromC < fromA ? m_Witness[c] : m_Witness[a], across });
    }
  }
  return cost;
}

void
BumpCollapse::CollectKeepers(ElementIndex vertex, ElementIndex other)
{
  const auto add = [&](ElementIndex keeper) {
    if (keeper != vertex && IsLive(keeper) && std::find(m_Keepers.begin(), m_Keepers.end(), keeper) == m_Keepers.end())
    {
      m_Keepers.push_back(keeper);
    }
  };
  for (const ElementIndex start : { vertex, other })
  {
    ElementIndex at = start;
    for (int step = 0; step < kUphillSteps && m_Uphill[at] != at; ++step)
    {
      at = m_Uphill[at];
      add(at);
    }
  }
  for (const ElementIndex centre : { vertex, other })
  {
    for (std::uint32_t i = m_NeighbourStart[centre]; i < m_NeighbourStart[centre + 1]; ++i)
    {
      add(m_Neighbours[i]);
    }
  }
}

double
BumpCollapse::VertexCost(ElementIndex vertex)
{
  m_NewHomes.clear();
  m_Keepers.clear();
  const std::uint32_t last = m_LastKept[vertex];
  if (last == kNone && m_Reserve[vertex] == 0)
  {
    return 0;
  }
  const auto & ends = m_Core->cells.edges[m_VertexCofaces[vertex].exclusiveOr];
  m_Heir = ends[0] == vertex ? ends[1] : ends[0];
  double cost = 0;
  if (last != kNone)
  {
    std::uint32_t point = last;
    do
    {
      point = m_NextKept[point];
      // Mostly the next vertex of the edge will do.
      Home home{ m_Heir, Gap(point, m_Heir) };
      if (home.gap > m_Level)
      {
        if (m_Keepers.empty())
        {
          CollectKeepers(vertex, m_Heir);
        }
        for (std::size_t i = 0; i < m_Keepers.size() && home.gap > m_Level; ++i)
        {
          const double gap = Gap(point, m_Keepers[i]);
          home = gap < home.gap ? Home{ m_Keepers[i], gap } : home;
        }
      }
      m_NewHomes.push_back(home);
      cost = std::max(cost, home.gap);
    } while (point != last);
    m_Looks += m_NewHomes.size();
  }
  return m_Reserve[vertex] == 0 ? cost : std::max(cost, m_Reserve[vertex] + Protrusion(vertex, m_Heir));
}

void
BumpCollapse::Push(const Pair & pair)
{
  m_Heap.push_back(pair);
  std::push_heap(m_Heap.begin(), m_Heap.end(), std::greater<>());
}

void
BumpCollapse::OfferVertex(ElementIndex vertex)
{
  // A vertex in one edge is in no face, as a face would need two edges there; so cofaces one dimension up suffice. Its
  // cost is looked at when its turn comes.
  if (m_VertexCofaces[vertex].count == 1)
  {
    Push({ 0, m_Core->vertexLambda[vertex], 0, vertex });
  }
}

void
BumpCollapse::OfferEdge(ElementIndex edge)
{
  if (m_EdgeCofaces[edge].count == 1)
  {
    Push({ FaceCost(edge), m_Core->edgeLambda[edge], 1, edge });
  }
}

void
BumpCollapse::DropEdge(ElementIndex edge)
{
  m_Bumps.edges[edge] = m_Level;
  for (const ElementIndex vertex : m_Core->cells.edges[edge])
  {
    --m_VertexCofaces[vertex].count;
    m_VertexCofaces[vertex].exclusiveOr ^= edge;
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
    m_Burnt[reached.vertex] = reached.time;
    m_Witness[reached.vertex] = reached.witness;
  }
  m_Bumps.faces[face] = m_Level;
  for (const ElementIndex side : m_Core->cells.FaceEdges(face))
  {
    --m_EdgeCofaces[side].count;
    m_EdgeCofaces[side].exclusiveOr ^= face;
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
  if (m_Reserve[vertex] > 0)
  {
    m_Reserve[m_Heir] = std::max(m_Reserve[m_Heir], m_Reserve[vertex] + Protrusion(vertex, m_Heir));
  }
  if (!m_NewHomes.empty())
  {
    // Ends of long curves drag along all that their lost parts kept. Once that has been looked at often enough, of long
    // lists only the greater gaps are followed one by one; for the others stands one number, which grows by what each
    // vertex sticks out of the next, and so is never too small.
    const bool    thin = m_Looks > kLooks * m_Points->size() && m_NewHomes.size() > kShortList;
    std::uint32_t point = m_NextKept[m_LastKept[vertex]];
    for (const Home & home : m_NewHomes)
    {
      const std::uint32_t next = m_NextKept[point];
      if (thin && home.gap < 0.5 * m_Level)
      {
        m_Reserve[home.vertex] = std::max({ m_Reserve[home.vertex], home.gap, kLeastReserve });
      }
      else
      {
        Keep(home.vertex, point);
      }
      point = next;
    }
  }
  DropEdge(m_VertexCofaces[vertex].exclusiveOr);
}

BumpValues
BumpCollapse::Run(const ProgressCallback & progress)
{
  for (std::size_t edge = 0; edge < m_EdgeCofaces.size(); ++edge)
  {
    OfferEdge(static_cast<ElementIndex>(edge));
  }
  for (std::size_t vertex = 0; vertex < m_VertexCofaces.size(); ++vertex)
  {
    OfferVertex(static_cast<ElementIndex>(vertex));
  }
  std::size_t count = 0;
  while (!m_Heap.empty())
  {
    if ((count++ & 0xFFFFU) == 0)
    {
      ReportProgress(progress, "prune", 0.0);
    }
    std::pop_heap(m_Heap.begin(), m_Heap.end(), std::greater<>());
    Pair pair = m_Heap.back();
    m_Heap.pop_back();
    const bool simple = pair.isEdge ? m_Bumps.edges[pair.element] == kLive && m_EdgeCofaces[pair.element].count == 1
                                    : IsLive(pair.element) && m_VertexCofaces[pair.element].count == 1;
    if (!simple)
    {
      continue;
    }
    // Fire may have come from elsewhere since, and keepers may have gone.
    const double cost = pair.isEdge ? FaceCost(pair.element) : VertexCost(pair.element);
    if (cost > pair.cost && !m_Heap.empty() && cost > m_Heap.front().cost)
    {
      pair.cost = cost;
      Push(pair);
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
  }
  for (auto * values : { &m_Bumps.vertices, &m_Bumps.edges, &m_Bumps.faces })
  {
    std::replace_if(
      values->begin(),
      values->end(),
      [](double value) { return value == kLive; },
      kInfinity);
  }
  return std::move(m_Bumps);
}

} // namespace voxelcore
