// What the collapse begins with.

#include "ToleranceCollapse.h"

#include "voxelcore/SimplePairCollapse.h"

#include <algorithm>
#include <limits>

namespace voxelcore
{

ToleranceCollapse::ToleranceCollapse(const MedialComplex &             core,
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
  , m_FaceTolerances(core.cells.FaceCount(), std::numeric_limits<double>::infinity())
  , m_Vertices(core.cells.vertexCount + 1)
  , m_VertexStanding(core.cells.vertexCount)
  , m_EdgeStanding(core.cells.edges.size())
  , m_NextKept(points.size())
  , m_Queue(0, 1.5 * m_Measured, Wake{ &core }) // few lie beyond; narrow buckets let more be fetched in time
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
      Keep(ball, point, Gap(PlaceOf(point), m_Vertices[ball]));
    }
  }
  touching.largest = {};
  FindNeighbours();
}

void
ToleranceCollapse::DropBelow(double floor, const ProgressCallback & progress)
{
  SimplePairCollapse collapse(m_Core->cells, m_Core->vertexLambda, m_Core->edgeLambda, m_Core->faceLambda);
  collapse.CollapseBelow(floor, progress);
  const auto drop = [](const std::vector<std::uint8_t> & live, auto && go) {
    for (std::size_t element = 0; element < live.size(); ++element)
    {
      if (live[element] == 0)
      {
        go(element);
      }
    }
  };
  drop(collapse.Live().vertices, [this](std::size_t vertex) { m_VertexStanding[vertex].Go(kBelowFloor); });
  drop(collapse.Live().edges, [this](std::size_t edge) { m_EdgeStanding[edge].Go(kBelowFloor); });
  drop(collapse.Live().faces, [this](std::size_t face) { m_FaceTolerances[face] = kBelowFloor; });
}

void
ToleranceCollapse::CountCofaces()
{
  const CellComplex & cells = m_Core->cells;
  for (std::size_t edge = 0; edge < cells.edges.size(); ++edge)
  {
    if (m_EdgeStanding[edge].IsLive())
    {
      m_VertexStanding[cells.edges[edge][0]].Add(static_cast<ElementIndex>(edge));
      m_VertexStanding[cells.edges[edge][1]].Add(static_cast<ElementIndex>(edge));
    }
  }
  for (std::size_t face = 0; face < cells.FaceCount(); ++face)
  {
    if (m_FaceTolerances[face] != kBelowFloor)
    {
      for (const ElementIndex edge : cells.FaceEdges(face))
      {
        m_EdgeStanding[edge].Add(static_cast<ElementIndex>(face));
      }
    }
  }
}

void
ToleranceCollapse::FindNeighbours()
{
  const CellComplex & cells = m_Core->cells;
  std::uint32_t       end = 0;
  for (std::size_t vertex = 0; vertex < cells.vertexCount; ++vertex)
  {
    m_Vertices[vertex].neighbours = end;
    end += m_VertexStanding[vertex].IsLive() ? m_VertexStanding[vertex].Count() : 0;
  }
  m_Vertices.back().neighbours = end;
  m_Neighbours.resize(end);
  std::vector<std::uint32_t> filled(cells.vertexCount, 0);
  for (std::size_t edge = 0; edge < cells.edges.size(); ++edge)
  {
    if (m_EdgeStanding[edge].IsLive())
    {
      const auto & [a, b] = cells.edges[edge];
      m_Neighbours[m_Vertices[a].neighbours + filled[a]++] = b;
      m_Neighbours[m_Vertices[b].neighbours + filled[b]++] = a;
    }
  }
}

} // namespace voxelcore
