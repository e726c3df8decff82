#include "ShortRods.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <queue>
#include <utility>

namespace voxelcore
{

ShortRods::ShortRods(const MedialComplex &              core,
                     const SheetPieces &                pieces,
                     const std::vector<std::uint32_t> & sheetOfFace,
                     double                             sliver)
  : m_Core(core)
  , m_Pieces(pieces)
  , m_Nets(core.cells.edges.size())
{
  FindRods(sheetOfFace);
  MeasureFromFeet();
  MeasureBridges();
  const auto isShort = [&](ElementIndex edge) {
    const auto net = m_Hanging.find(m_Nets.Find(edge));
    return net != m_Hanging.end() &&
           net->second.standOut < std::max(sliver, net->second.thickness / net->second.length);
  };
  for (ElementIndex edge = 0; edge < core.cells.edges.size(); ++edge)
  {
    if (pieces.FacesOf(edge).empty() && isShort(edge))
    {
      m_Edges.push_back(edge);
      m_NetsOfEdges.push_back(m_Nets.Find(edge));
    }
  }
}

void
ShortRods::FindRods(const std::vector<std::uint32_t> & sheetOfFace)
{
  const CellComplex & cells = m_Core.cells;
  for (ElementIndex edge = 0; edge < cells.edges.size(); ++edge)
  {
    if (m_Pieces.FacesOf(edge).empty())
    {
      m_Around[cells.edges[edge][0]].push_back(edge);
      m_Around[cells.edges[edge][1]].push_back(edge);
    }
  }
  std::vector<char> isOnRod(cells.vertexCount, 0);
  for (const auto & [vertex, edges] : m_Around)
  {
    isOnRod[vertex] = 1;
  }
  for (ElementIndex face = 0; face < sheetOfFace.size(); ++face)
  {
    for (const ElementIndex vertex : cells.FaceVertices(face))
    {
      if (isOnRod[vertex] != 0)
      {
        m_SheetsAt[vertex].push_back(sheetOfFace[face]);
      }
    }
  }
  for (auto & [vertex, sheets] : m_SheetsAt)
  {
    std::sort(sheets.begin(), sheets.end());
    sheets.erase(std::unique(sheets.begin(), sheets.end()), sheets.end());
  }
  for (const auto & [vertex, edges] : m_Around)
  {
    for (const ElementIndex edge : IsFoot(vertex) ? std::vector<ElementIndex>() : edges)
    {
      m_Nets.Unite(edges.front(), edge);
    }
  }
}

void
ShortRods::MeasureFromFeet()
{
  using Entry = std::pair<double, ElementIndex>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (const auto & [vertex, sheets] : m_SheetsAt)
  {
    m_Ways[vertex] = { -m_Core.radius[vertex], vertex };
    queue.emplace(-m_Core.radius[vertex], vertex);
  }
  while (!queue.empty())
  {
    const auto [way, vertex] = queue.top();
    queue.pop();
    if (way > m_Ways.at(vertex).way)
    {
      continue;
    }
    const ElementIndex foot = m_Ways.at(vertex).foot;
    for (const ElementIndex edge : m_Around.at(vertex))
    {
      Net &              net = m_Hanging[m_Nets.Find(edge)];
      const auto &       ends = m_Core.cells.edges[edge];
      const ElementIndex next = ends[0] ^ ends[1] ^ vertex;
      const double       length = m_Pieces.EdgeLength(edge);
      const double       further = way + length;
      net.standOut = std::max(net.standOut, way + m_Core.radius[vertex]);
      net.length += length / 2; // it comes from both ends
      net.thickness += length * m_Core.radius[vertex];
      const auto [place, isNew] = m_Ways.try_emplace(next, Reached{ further, foot });
      if (isNew || further < place->second.way)
      {
        place->second = { further, foot };
        queue.emplace(further, next);
      }
    }
  }
}

void
ShortRods::MeasureBridges()
{
  const auto wayFromFoot = [&](const Reached & one) { return one.way + m_Core.radius[one.foot]; };
  for (ElementIndex edge = 0; edge < m_Core.cells.edges.size(); ++edge)
  {
    const auto & ends = m_Core.cells.edges[edge];
    const auto   one = m_Ways.find(ends[0]);
    const auto   other = m_Ways.find(ends[1]);
    if (!m_Pieces.FacesOf(edge).empty() || one == m_Ways.end() || other == m_Ways.end())
    {
      continue;
    }
    const auto &               a = m_SheetsAt.at(one->second.foot);
    const auto &               b = m_SheetsAt.at(other->second.foot);
    std::vector<std::uint32_t> both;
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
    if (both.empty())
    {
      Net & net = m_Hanging.at(m_Nets.Find(edge));
      net.standOut =
        std::max(net.standOut, wayFromFoot(one->second) + m_Pieces.EdgeLength(edge) + wayFromFoot(other->second));
    }
  }
}

} // namespace voxelcore
