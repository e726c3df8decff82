#include "RimStrip.h"

#include "voxelcore/Base/ParallelTasks.h"

#include <algorithm>
#include <utility>

namespace voxelcore
{

namespace
{

std::vector<ElementIndex>
Between(const std::vector<double> & values, double low, double high)
{
  std::vector<ElementIndex> elements;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    if (values[i] > low && values[i] <= high)
    {
      elements.push_back(static_cast<ElementIndex>(i));
    }
  }
  return elements;
}

std::vector<RimStrip::Level>
LevelsOf(const std::vector<ElementIndex> & elements, const std::vector<double> & values, const ToleranceLevels & levels)
{
  std::vector<RimStrip::Level> all;
  all.reserve(elements.size());
  for (const ElementIndex element : elements)
  {
    all.push_back(static_cast<RimStrip::Level>(levels.LevelOf(values[element])));
  }
  return all;
}

std::vector<ElementIndex>
NumbersOf(const std::vector<ElementIndex> & elements, std::size_t count)
{
  std::vector<ElementIndex> numbers(count, kNobody);
  for (std::size_t i = 0; i < elements.size(); ++i)
  {
    numbers[elements[i]] = static_cast<ElementIndex>(i);
  }
  return numbers;
}

} // namespace

RimStrip::RimStrip(const CellComplex &     cells,
                   const ToleranceValues & values,
                   const ToleranceLevels & levels,
                   double                  low,
                   double                  high)
{
  const bool worthThreads = cells.FaceCount() > 10000;
  RunBoth(
    worthThreads,
    [&] {
      m_Edges = Between(values.edges, low, high);
      m_EdgeLevels = LevelsOf(m_Edges, values.edges, levels);
    },
    [&] {
      m_Faces = Between(values.faces, low, high);
      m_FaceLevels = LevelsOf(m_Faces, values.faces, levels);
      m_Vertices = Between(values.vertices, low, high);
      m_VertexLevels = LevelsOf(m_Vertices, values.vertices, levels);
    });
  RunBoth(
    worthThreads,
    [&] { ConnectFaces(cells, values.faces, high); },
    [&] { ConnectEdges(cells); });
}

void
RimStrip::ConnectEdges(const CellComplex & cells)
{
  m_EdgesAt.resize(m_Vertices.size());
  m_Ends.assign(m_Edges.size(), { kNobody, kNobody });
  const std::vector<ElementIndex> numbers = NumbersOf(m_Vertices, cells.vertexCount);
  for (std::size_t edge = 0; edge < m_Edges.size(); ++edge)
  {
    for (std::size_t end = 0; end < 2; ++end)
    {
      const ElementIndex vertex = numbers[cells.edges[m_Edges[edge]][end]];
      m_Ends[edge][end] = vertex;
      if (vertex != kNobody)
      {
        m_EdgesAt[vertex].Add(static_cast<ElementIndex>(edge));
      }
    }
  }
}

void
RimStrip::ConnectFaces(const CellComplex & cells, const std::vector<double> & heights, double high)
{
  m_FacesAt.resize(m_Edges.size());
  constexpr ElementIndex    kBorder = kNobody - 1; // an edge that stays, of a face that is here
  std::vector<ElementIndex> numbers = NumbersOf(m_Edges, cells.edges.size());
  for (std::size_t face = 0; face < m_Faces.size(); ++face)
  {
    for (const ElementIndex edge : cells.FaceEdges(m_Faces[face]))
    {
      if (numbers[edge] < kBorder)
      {
        m_FacesAt[numbers[edge]].Add(static_cast<ElementIndex>(face));
        m_FaceEdges.push_back(numbers[edge]);
        continue;
      }
      numbers[edge] = kBorder;
      m_Meetings.push_back({ edge, m_Faces[face], static_cast<ElementIndex>(face) });
    }
    m_FaceOffsets.push_back(static_cast<std::uint32_t>(m_FaceEdges.size()));
  }
  for (std::size_t face = 0; face < heights.size(); ++face)
  {
    if (heights[face] > high)
    {
      for (const ElementIndex edge : cells.FaceEdges(face))
      {
        if (numbers[edge] == kBorder)
        {
          m_Meetings.push_back({ edge, static_cast<ElementIndex>(face), Staying() });
        }
      }
    }
  }
  for (std::size_t face = 0; face < m_Faces.size(); ++face)
  {
    for (const ElementIndex edge : EdgesOf(static_cast<ElementIndex>(face)))
    {
      if (m_FacesAt[edge].count > 2)
      {
        m_Meetings.push_back({ m_Edges[edge], m_Faces[face], static_cast<ElementIndex>(face) });
      }
    }
  }
  std::sort(m_Meetings.begin(), m_Meetings.end(), [](const Meeting & a, const Meeting & b) {
    return a.edge != b.edge ? a.edge < b.edge : a.face < b.face;
  });
}

void
RimStrip::RaiseTo(std::vector<Level> levels)
{
  m_FaceLevels = std::move(levels);
  for (ElementIndex face = 0; face < m_Faces.size(); ++face)
  {
    for (const ElementIndex edge : EdgesOf(face))
    {
      m_EdgeLevels[edge] = std::max(m_EdgeLevels[edge], m_FaceLevels[face]);
    }
  }
  for (std::size_t edge = 0; edge < m_Edges.size(); ++edge)
  {
    for (const ElementIndex end : m_Ends[edge])
    {
      if (end != kNobody)
      {
        m_VertexLevels[end] = std::max(m_VertexLevels[end], m_EdgeLevels[edge]);
      }
    }
  }
}

void
RimStrip::Collapse(const ToleranceLevels & levels, ToleranceValues & values)
{
  m_Turns.assign(levels.LevelOf(levels.Measured()) + 1, {});
  for (ElementIndex edge = 0; edge < m_Edges.size(); ++edge)
  {
    OfferEdge(edge);
  }
  for (ElementIndex vertex = 0; vertex < m_Vertices.size(); ++vertex)
  {
    OfferVertex(vertex);
  }
  for (; m_Level < m_Turns.size(); ++m_Level)
  {
    const double height = levels.Height(m_Level);
    for (std::size_t i = 0; i < m_Turns[m_Level].size(); ++i)
    {
      const Turn turn = m_Turns[m_Level][i];
      turn.isEdge ? RemoveEdge(turn.element, height, values) : RemoveVertex(turn.element, height, values);
    }
    std::vector<Turn>().swap(m_Turns[m_Level]);
  }
}

void
RimStrip::RemoveEdge(ElementIndex edge, double height, ToleranceValues & values)
{
  if (m_EdgeLevels[edge] == kGone || m_FacesAt[edge].count != 1)
  {
    return;
  }
  const ElementIndex face = m_FacesAt[edge].exclusiveOr;
  m_EdgeLevels[edge] = kGone;
  values.edges[m_Edges[edge]] = height;
  values.faces[m_Faces[face]] = height;
  for (const ElementIndex end : m_Ends[edge])
  {
    if (end != kNobody)
    {
      m_EdgesAt[end].Remove(edge);
    }
  }
  for (const ElementIndex side : EdgesOf(face))
  {
    m_FacesAt[side].Remove(face);
    OfferEdge(side);
    OfferVertex(m_Ends[side][0]);
    OfferVertex(m_Ends[side][1]);
  }
}

void
RimStrip::RemoveVertex(ElementIndex vertex, double height, ToleranceValues & values)
{
  if (m_VertexLevels[vertex] == kGone || m_EdgesAt[vertex].count != 1)
  {
    return;
  }
  const ElementIndex edge = m_EdgesAt[vertex].exclusiveOr;
  m_VertexLevels[vertex] = kGone;
  m_EdgeLevels[edge] = kGone;
  values.vertices[m_Vertices[vertex]] = height;
  values.edges[m_Edges[edge]] = height;
  for (const ElementIndex end : m_Ends[edge])
  {
    if (end != kNobody)
    {
      m_EdgesAt[end].Remove(edge);
      OfferVertex(end);
    }
  }
}

} // namespace voxelcore
