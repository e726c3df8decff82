#include "SheetPieces.h"

#include "voxelcore/Base/UnionFind.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/VoxelCore/PolygonArea.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <numeric>
#include <queue>
#include <utility>

namespace voxelcore
{

SheetPieces::SheetPieces(const MedialComplex & core)
  : m_Core(core)
  , m_EdgeOffsets(core.cells.edges.size() + 1, 0)
  , m_Live(core.cells.edges.size(), 0)
  , m_Drawn(core.cells.edges.size(), 0)
  , m_AroundOffsets(core.cells.vertexCount + 1, 0)
  , m_Alive(core.cells.FaceCount(), 1)
  , m_Local(core.cells.vertexCount, kNoPiece)
{
  const CellComplex & cells = core.cells;
  for (const ElementIndex edge : cells.faceEdges)
  {
    ++m_Live[edge];
  }
  std::partial_sum(m_Live.begin(), m_Live.end(), m_EdgeOffsets.begin() + 1);
  for (const auto & ends : cells.edges)
  {
    ++m_AroundOffsets[ends[0] + 1];
    ++m_AroundOffsets[ends[1] + 1];
  }
  std::partial_sum(m_AroundOffsets.begin(), m_AroundOffsets.end(), m_AroundOffsets.begin());
  m_Around.resize(2 * cells.edges.size());
  std::vector<std::uint64_t> next(m_AroundOffsets.begin(), m_AroundOffsets.end() - 1);
  for (ElementIndex edge = 0; edge < cells.edges.size(); ++edge)
  {
    m_Around[next[cells.edges[edge][0]]++] = edge;
    m_Around[next[cells.edges[edge][1]]++] = edge;
  }
  m_EdgeFaces.resize(cells.faceEdges.size());
  std::vector<std::uint64_t> at(m_EdgeOffsets.begin(), m_EdgeOffsets.end() - 1);
  for (ElementIndex face = 0; face < cells.FaceCount(); ++face)
  {
    for (const ElementIndex edge : cells.FaceEdges(face))
    {
      m_EdgeFaces[at[edge]++] = face;
    }
  }
}

double
SheetPieces::EdgeLength(ElementIndex edge) const
{
  const auto & ends = m_Core.cells.edges[edge];
  return Distance(m_Core.positions[ends[0]], m_Core.positions[ends[1]]);
}

void
SheetPieces::Find()
{
  const CellComplex & cells = m_Core.cells;
  m_PieceOf.assign(cells.FaceCount(), kNoPiece);
  m_Pieces.clear();
  std::vector<ElementIndex> waiting;
  for (ElementIndex first = 0; first < cells.FaceCount(); ++first)
  {
    if (m_Alive[first] == 0 || m_PieceOf[first] != kNoPiece)
    {
      continue;
    }
    const auto piece = static_cast<std::uint32_t>(m_Pieces.size());
    m_Pieces.emplace_back();
    m_PieceOf[first] = piece;
    waiting.push_back(first);
    while (!waiting.empty())
    {
      const ElementIndex face = waiting.back();
      waiting.pop_back();
      m_Pieces[piece].area += PolygonArea(m_Core.positions, cells.FaceVertices(face));
      for (const ElementIndex edge : cells.FaceEdges(face))
      {
        for (const ElementIndex other : IsInner(edge) ? FacesOf(edge) : std::span<const ElementIndex>())
        {
          if (m_Alive[other] != 0 && m_PieceOf[other] == kNoPiece)
          {
            m_PieceOf[other] = piece;
            waiting.push_back(other);
          }
        }
      }
    }
  }
  m_Strip.assign(m_Pieces.size(), 0);
  m_Joined.resize(m_Pieces.size());
  std::iota(m_Joined.begin(), m_Joined.end(), 0U);
  Measure();
}

void
SheetPieces::Measure()
{
  std::vector<std::uint64_t> starts(m_Pieces.size() + 1, 0);
  for (const std::uint32_t piece : m_PieceOf)
  {
    if (piece != kNoPiece)
    {
      ++starts[piece + 1];
    }
  }
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  std::vector<ElementIndex>  faces(starts.back());
  std::vector<std::uint64_t> at(starts.begin(), starts.end() - 1);
  for (ElementIndex face = 0; face < m_PieceOf.size(); ++face)
  {
    if (m_PieceOf[face] != kNoPiece)
    {
      faces[at[m_PieceOf[face]]++] = face;
    }
  }
  for (std::size_t piece = 0; piece < m_Pieces.size(); ++piece)
  {
    const std::span<const ElementIndex> own{ faces.data() + starts[piece], faces.data() + starts[piece + 1] };
    MeasureStandOut(own, m_Pieces[piece]);
  }
}

void
SheetPieces::MeasureStandOut(std::span<const ElementIndex> faces, SheetPiece & piece)
{
  const CellComplex &       cells = m_Core.cells;
  std::vector<ElementIndex> vertices;
  std::vector<ElementIndex> edges;
  for (const ElementIndex face : faces)
  {
    for (const ElementIndex vertex : cells.FaceVertices(face))
    {
      if (m_Local[vertex] == kNoPiece)
      {
        m_Local[vertex] = static_cast<std::uint32_t>(vertices.size());
        vertices.push_back(vertex);
      }
    }
    for (const ElementIndex edge : cells.FaceEdges(face))
    {
      const double length = EdgeLength(edge);
      const auto & ends = cells.edges[edge];
      piece.freeBorder += m_Live[edge] == 1 ? length : 0.0;
      piece.seamBorder += IsBorder(edge) ? length : 0.0;
      piece.drawnBorder += IsBorder(edge) && m_Live[edge] == 2 ? length : 0.0;
      piece.seamWidth += IsBorder(edge) ? length * (m_Core.radius[ends[0]] + m_Core.radius[ends[1]]) : 0.0;
      edges.push_back(edge);
    }
  }
  piece.standOut = std::numeric_limits<double>::infinity();
  if (piece.seamBorder > 0)
  {
    piece.seamWidth /= piece.seamBorder;
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    std::vector<std::uint32_t> starts(vertices.size() + 1, 0);
    for (const ElementIndex edge : edges)
    {
      for (const ElementIndex end : cells.edges[edge])
      {
        ++starts[m_Local[end] + 1];
      }
    }
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    std::vector<ElementIndex>  around(2 * edges.size());
    std::vector<std::uint32_t> at(starts.begin(), starts.end() - 1);
    std::vector<double>        reached(vertices.size(), std::numeric_limits<double>::infinity());
    using Entry = std::pair<double, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (const ElementIndex edge : edges)
    {
      for (const ElementIndex end : cells.edges[edge])
      {
        const std::uint32_t local = m_Local[end];
        around[at[local]++] = edge;
        if (IsBorder(edge) && reached[local] > -m_Core.radius[end])
        {
          reached[local] = -m_Core.radius[end];
          queue.emplace(reached[local], local);
        }
      }
    }
    piece.standOut = 0;
    while (!queue.empty())
    {
      const auto [way, local] = queue.top();
      queue.pop();
      if (way > reached[local])
      {
        continue;
      }
      const ElementIndex vertex = vertices[local];
      piece.standOut = std::max(piece.standOut, way + m_Core.radius[vertex]);
      for (std::uint32_t i = starts[local]; i < starts[local + 1]; ++i)
      {
        const auto &        ends = cells.edges[around[i]];
        const std::uint32_t other = m_Local[ends[0] ^ ends[1] ^ vertex];
        const double        further = way + EdgeLength(around[i]);
        if (further < reached[other])
        {
          reached[other] = further;
          queue.emplace(further, other);
        }
      }
    }
  }
  for (const ElementIndex vertex : vertices)
  {
    m_Local[vertex] = kNoPiece;
  }
}

Vector3
SheetPieces::Inwards(ElementIndex face, ElementIndex edge) const
{
  const auto &  ends = m_Core.cells.edges[edge];
  const Vector3 along = Minus(m_Core.positions[ends[1]], m_Core.positions[ends[0]]);
  Vector3       middle{ 0, 0, 0 };
  const auto    corners = m_Core.cells.FaceVertices(face);
  for (const ElementIndex corner : corners)
  {
    middle = AddScaled(middle, 1.0 / static_cast<double>(corners.size()), m_Core.positions[corner]);
  }
  Vector3      way = Minus(middle, m_Core.positions[ends[0]]);
  const double squared = Dot(along, along);
  way = squared > 0 ? AddScaled(way, -Dot(way, along) / squared, along) : way;
  const double length = Length(way);
  return length > 0 ? AddScaled({ 0, 0, 0 }, 1 / length, way) : way;
}

void
SheetPieces::JoinStrips(double height)
{
  std::vector<std::map<std::uint32_t, double>> continues(m_Pieces.size()); // by neighbour
  std::vector<std::uint32_t>                   strips;
  for (std::uint32_t piece = 0; piece < m_Pieces.size(); ++piece)
  {
    if (IsSliver(m_Pieces[piece], height))
    {
      m_Strip[piece] = 1;
      strips.push_back(piece);
    }
  }
  if (strips.empty())
  {
    return;
  }
  for (ElementIndex edge = 0; edge < m_Live.size(); ++edge)
  {
    if (!IsBorder(edge))
    {
      continue;
    }
    for (const ElementIndex one : FacesOf(edge))
    {
      if (m_Alive[one] == 0 || m_Strip[m_PieceOf[one]] == 0)
      {
        continue;
      }
      for (const ElementIndex other : FacesOf(edge))
      {
        if (m_Alive[other] != 0 && m_PieceOf[other] != m_PieceOf[one])
        {
          continues[m_PieceOf[one]][m_PieceOf[other]] +=
            EdgeLength(edge) * std::max(0.0, -Dot(Inwards(one, edge), Inwards(other, edge)));
        }
      }
    }
  }
  std::stable_sort(strips.begin(), strips.end(), [&](std::uint32_t a, std::uint32_t b) {
    return m_Pieces[a].area < m_Pieces[b].area;
  });
  UnionFind sets(m_Pieces.size());
  for (const std::uint32_t strip : strips)
  {
    std::uint32_t best = kNoPiece;
    double        greatest = 0;
    for (const auto & [other, score] : continues[strip])
    {
      if (sets.Find(other) != sets.Find(strip) && (best == kNoPiece || score > greatest))
      {
        best = other;
        greatest = score;
      }
    }
    if (best != kNoPiece)
    {
      sets.Unite(strip, best);
    }
  }
  for (std::uint32_t piece = 0; piece < m_Pieces.size(); ++piece)
  {
    m_Joined[piece] = sets.Find(piece);
  }
}

std::vector<std::uint32_t>
SheetPieces::PieceOfFaces() const
{
  const CellComplex &        cells = m_Core.cells;
  std::vector<std::uint32_t> pieces(m_PieceOf.size(), kNoPiece);
  std::vector<ElementIndex>  layer;
  for (ElementIndex face = 0; face < pieces.size(); ++face)
  {
    if (m_PieceOf[face] != kNoPiece)
    {
      pieces[face] = m_Joined[m_PieceOf[face]];
      layer.push_back(face);
    }
  }
  // Fins, layer by layer, each face from the neighbour with the longest common
  // edge.
  while (!layer.empty())
  {
    std::map<ElementIndex, std::pair<double, std::uint32_t>> found;
    for (const ElementIndex face : layer)
    {
      for (const ElementIndex edge : cells.FaceEdges(face))
      {
        for (const ElementIndex other : FacesOf(edge))
        {
          if (pieces[other] == kNoPiece)
          {
            const std::pair<double, std::uint32_t> way{ EdgeLength(edge), pieces[face] };
            auto [place, isNew] = found.try_emplace(other, way);
            if (!isNew && (way.first > place->second.first ||
                           (way.first == place->second.first && way.second < place->second.second)))
            {
              place->second = way;
            }
          }
        }
      }
    }
    layer.clear();
    for (const auto & [face, way] : found)
    {
      pieces[face] = way.second;
      layer.push_back(face);
    }
  }
  return pieces;
}

} // namespace voxelcore
