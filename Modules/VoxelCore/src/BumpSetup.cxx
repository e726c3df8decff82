// What the collapse begins with.

#include "BumpCollapse.h"

#include "voxelcore/SimplePairCollapse.h"

#include <algorithm>

namespace voxelcore
{

BumpCollapse::BumpCollapse(const MedialComplex &             core,
                           const SpacingWeights &            weights,
                           const std::vector<LatticePoint> & points,
                           TouchingBalls                     touching,
                           double                            floor,
                           const ProgressCallback &          progress)
  : m_Core(&core)
  , m_Points(&points)
  , m_Scale{ weights.unit * static_cast<double>(weights.weight[0]),
             weights.unit * static_cast<double>(weights.weight[1]),
             weights.unit * static_cast<double>(weights.weight[2]) }
  , m_Measured(kMeasured * std::sqrt(SquaredDistance(m_Scale, { 0, 0, 0 })))
  , m_Bumps{ std::vector<double>(core.cells.vertexCount, kLive),
             std::vector<double>(core.cells.edges.size(), kLive),
             std::vector<double>(core.cells.FaceCount(), kLive) }
  , m_Vertices(core.cells.vertexCount + 1)
  , m_VertexCofaces(core.cells.vertexCount)
  , m_EdgeCofaces(core.cells.edges.size())
  , m_NextKept(points.size())
  , m_Queue(0, core.radius.empty() ? 0.0 : *std::max_element(core.radius.begin(), core.radius.end()))
{
  if (floor > 0)
  {
    DropBelow(floor, progress);
  }
  CountCofaces();
  for (ElementIndex vertex = 0; vertex < core.cells.vertexCount; ++vertex)
  {
    const auto & p = touching.places[vertex];
    m_Vertices[vertex] = {
      { m_Scale[0] * p[0], m_Scale[1] * p[1], m_Scale[2] * p[2] }, core.radius[vertex], 0, 0, vertex, kNone, kNone, 0
    };
  }
  touching.places = {};
  for (std::uint32_t point = 0; point < points.size(); ++point)
  {
    const ElementIndex ball = touching.largest[point];
    if (IsLive(ball))
    {
      Keep(ball, point, Gap(point, m_Vertices[ball]));
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
    if (m_Bumps.edges[edge] == kLive)
    {
      m_VertexCofaces[cells.edges[edge][0]].Add(static_cast<ElementIndex>(edge));
      m_VertexCofaces[cells.edges[edge][1]].Add(static_cast<ElementIndex>(edge));
    }
  }
  for (std::size_t face = 0; face < cells.FaceCount(); ++face)
  {
    if (m_Bumps.faces[face] == kLive)
    {
      for (const ElementIndex edge : cells.FaceEdges(face))
      {
        m_EdgeCofaces[edge].Add(static_cast<ElementIndex>(face));
      }
    }
  }
}

void
BumpCollapse::FindNeighbours()
{
  const CellComplex & cells = m_Core->cells;
  std::uint32_t       end = 0;
  for (std::size_t vertex = 0; vertex < cells.vertexCount; ++vertex)
  {
    m_Vertices[vertex].neighbours = end;
    end += m_VertexCofaces[vertex].count;
  }
  m_Vertices.back().neighbours = end;
  m_Neighbours.resize(end);
  std::vector<std::uint32_t> filled(cells.vertexCount, 0);
  for (std::size_t edge = 0; edge < cells.edges.size(); ++edge)
  {
    if (m_Bumps.edges[edge] == kLive)
    {
      const auto & [a, b] = cells.edges[edge];
      m_Neighbours[m_Vertices[a].neighbours + filled[a]++] = b;
      m_Neighbours[m_Vertices[b].neighbours + filled[b]++] = a;
    }
  }
}

} // namespace voxelcore
