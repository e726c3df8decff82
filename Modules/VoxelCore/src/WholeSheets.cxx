#include "WholeSheets.h"

#include "voxelcore/UnionFind.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

namespace voxelcore
{

namespace
{

constexpr double kStaircase = 0.8;   ///< voxel diagonals
constexpr double kWide = 0.643;      ///< of the radius
constexpr double kStraight = -0.743; ///< cosine between the directions of two faces away from their edge, at most
constexpr double kTie = 1e-6;        ///< cosines that differ by less are equal: neither is the straightest

using Level = std::uint16_t;

bool
IsWide(const MedialComplex & core, ElementIndex face)
{
  const auto corners = core.cells.FaceVertices(face);
  double     sum = 0;
  for (const ElementIndex corner : corners)
  {
    sum += core.radius[corner];
  }
  return core.faceLambda[face] * static_cast<double>(corners.size()) >= kWide * sum;
}

// Away from one of its edges, within the face.
BallCentre
Outwards(const CellComplex & cells, const std::vector<CoreBall> & balls, ElementIndex face, ElementIndex edge)
{
  const BallCentre & p = balls[cells.edges[edge][0]].centre;
  const BallCentre & q = balls[cells.edges[edge][1]].centre;
  const auto         corners = cells.FaceVertices(face);
  BallCentre         away{};
  for (const ElementIndex corner : corners)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      away[axis] += (balls[corner].centre[axis] - p[axis]) / static_cast<double>(corners.size());
    }
  }
  const double along =
    (away[0] * (q[0] - p[0]) + away[1] * (q[1] - p[1]) + away[2] * (q[2] - p[2])) / SquaredDistance(p, q);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    away[axis] -= along * (q[axis] - p[axis]);
  }
  const double length = std::sqrt(away[0] * away[0] + away[1] * away[1] + away[2] * away[2]);
  return { away[0] / length, away[1] / length, away[2] / length };
}

// A face at an edge of several.
struct Meeting
{
  ElementIndex edge; // of the core
  ElementIndex face; // of the core
  ElementIndex node; // of the strip, or what stays
};

// What fire has taken between two heights. Its elements are numbered anew, in the same order; whatever such an element
// bounds is here, too.
class Strip
{
public:
  Strip(const CellComplex & cells, const ToleranceValues & values, const ToleranceLevels & levels)
    : m_Low(kStaircase * levels.Diagonal())
    , m_High(levels.Measured())
    , m_Faces(Elements(values.faces))
    , m_Edges(Elements(values.edges))
    , m_Vertices(Elements(values.vertices))
    , m_FaceLevels(LevelsOf(m_Faces, values.faces, levels))
    , m_EdgeLevels(LevelsOf(m_Edges, values.edges, levels))
    , m_VertexLevels(LevelsOf(m_Vertices, values.vertices, levels))
    , m_FacesAt(m_Edges.size())
    , m_EdgesAt(m_Vertices.size())
    , m_Ends(m_Edges.size(), { kNobody, kNobody })
  {
    ConnectEdges(cells);
    ConnectFaces(cells, values.faces);
  }

  bool
  IsEmpty() const
  {
    return m_Faces.empty();
  }

  // Gives all faces of a sheet the level of its last, and so to what they are bounded by.
  void
  RaiseSheets(const MedialComplex & core, const std::vector<CoreBall> & balls, std::size_t highest);

  // Heights when everything has gone that is simple at its turn.
  void
  Collapse(const ToleranceLevels & levels, ToleranceValues & values);

private:
  std::vector<ElementIndex>
  Elements(const std::vector<double> & values) const
  {
    std::vector<ElementIndex> elements;
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      if (values[i] > m_Low && values[i] <= m_High)
      {
        elements.push_back(static_cast<ElementIndex>(i));
      }
    }
    return elements;
  }
  static std::vector<Level>
  LevelsOf(const std::vector<ElementIndex> & elements,
           const std::vector<double> &       values,
           const ToleranceLevels &           levels)
  {
    std::vector<Level> all;
    all.reserve(elements.size());
    for (const ElementIndex element : elements)
    {
      all.push_back(static_cast<Level>(levels.LevelOf(values[element])));
    }
    return all;
  }
  static std::vector<ElementIndex>
  NumbersOf(const std::vector<ElementIndex> & elements, std::size_t count)
  {
    std::vector<ElementIndex> numbers(count, kNobody);
    for (std::size_t i = 0; i < elements.size(); ++i)
    {
      numbers[elements[i]] = static_cast<ElementIndex>(i);
    }
    return numbers;
  }
  std::span<const ElementIndex>
  EdgesOf(ElementIndex face) const
  {
    return { m_FaceEdges.data() + m_FaceOffsets[face], m_FaceEdges.data() + m_FaceOffsets[face + 1] };
  }
  ElementIndex
  Staying() const
  {
    return static_cast<ElementIndex>(m_Faces.size());
  }

  void
  ConnectEdges(const CellComplex & cells);
  void
  ConnectFaces(const CellComplex & cells, const std::vector<double> & heights);
  void
  UniteStraightest(const MedialComplex &         core,
                   const std::vector<CoreBall> & balls,
                   std::span<const Meeting>      seam,
                   UnionFind &                   sheets) const;

  struct Turn
  {
    bool         isEdge;
    ElementIndex element;
  };
  void
  OfferEdge(ElementIndex edge)
  {
    if (m_EdgeLevels[edge] != kGone && m_FacesAt[edge].count == 1)
    {
      m_Turns[std::max(m_Level, std::size_t{ m_EdgeLevels[edge] })].push_back({ true, edge });
    }
  }
  void
  OfferVertex(ElementIndex vertex)
  {
    if (vertex != kNobody && m_VertexLevels[vertex] != kGone && m_EdgesAt[vertex].count == 1 &&
        m_FacesAt[m_EdgesAt[vertex].exclusiveOr].count == 0)
    {
      m_Turns[std::max(m_Level, std::size_t{ m_VertexLevels[vertex] })].push_back({ false, vertex });
    }
  }
  void
  RemoveEdge(ElementIndex edge, double height, ToleranceValues & values);
  void
  RemoveVertex(ElementIndex vertex, double height, ToleranceValues & values);

  static constexpr Level kGone = 0xFFFF;

  double                                   m_Low;
  double                                   m_High;
  std::vector<ElementIndex>                m_Faces;
  std::vector<ElementIndex>                m_Edges;
  std::vector<ElementIndex>                m_Vertices;
  std::vector<Level>                       m_FaceLevels;
  std::vector<Level>                       m_EdgeLevels;
  std::vector<Level>                       m_VertexLevels;
  std::vector<Cofaces>                     m_FacesAt; // of each edge
  std::vector<Cofaces>                     m_EdgesAt; // of each vertex
  std::vector<std::array<ElementIndex, 2>> m_Ends;    // of each edge, those that are here
  std::vector<std::uint32_t>               m_FaceOffsets{ 0 };
  std::vector<ElementIndex>                m_FaceEdges; // of each face, those that are here
  std::vector<Meeting>                     m_Meetings;  // where not just two faces of the strip meet; by edge
  std::size_t                              m_Level = 0;
  std::vector<std::vector<Turn>>           m_Turns;
};

void
Strip::ConnectEdges(const CellComplex & cells)
{
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
Strip::ConnectFaces(const CellComplex & cells, const std::vector<double> & heights)
{
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
    if (heights[face] > m_High)
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

// Pairs go on as one sheet that are the straightest for both.
void
Strip::UniteStraightest(const MedialComplex &         core,
                        const std::vector<CoreBall> & balls,
                        std::span<const Meeting>      seam,
                        UnionFind &                   sheets) const
{
  std::vector<BallCentre> directions;
  directions.reserve(seam.size());
  for (const Meeting & meeting : seam)
  {
    directions.push_back(Outwards(core.cells, balls, meeting.face, meeting.edge));
  }
  const auto straightest = [&](std::size_t i) {
    std::size_t best = i;
    double      least = kStraight;
    double      second = kStraight;
    for (std::size_t j = 0; j < seam.size(); ++j)
    {
      const BallCentre & a = directions[i];
      const BallCentre & b = directions[j];
      const double       cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
      if (j != i && cosine < least)
      {
        second = std::exchange(least, cosine);
        best = j;
      }
      else if (j != i)
      {
        second = std::min(second, cosine);
      }
    }
    return least < second - kTie ? best : i;
  };
  for (std::size_t i = 0; i < seam.size(); ++i)
  {
    const std::size_t j = straightest(i);
    if (i < j && straightest(j) == i && IsWide(core, seam[i].face) && IsWide(core, seam[j].face))
    {
      sheets.Unite(seam[i].node, seam[j].node);
    }
  }
}

void
Strip::RaiseSheets(const MedialComplex & core, const std::vector<CoreBall> & balls, std::size_t highest)
{
  UnionFind                 sheets(m_Faces.size() + 1);
  std::vector<std::uint8_t> wide(m_Faces.size());
  for (std::size_t face = 0; face < wide.size(); ++face)
  {
    wide[face] = IsWide(core, m_Faces[face]) ? 1 : 0;
  }
  for (ElementIndex face = 0; face < m_Faces.size(); ++face)
  {
    for (const ElementIndex edge : EdgesOf(face))
    {
      const ElementIndex other = m_FacesAt[edge].exclusiveOr ^ face;
      if (m_FacesAt[edge].count == 2 && face < other && wide[face] != 0 && wide[other] != 0)
      {
        const std::array<Meeting, 2> pair{ { { m_Edges[edge], m_Faces[face], face },
                                             { m_Edges[edge], m_Faces[other], other } } };
        UniteStraightest(core, balls, pair, sheets);
      }
    }
  }
  for (std::size_t first = 0, last = 0; first < m_Meetings.size(); first = last)
  {
    while (last < m_Meetings.size() && m_Meetings[last].edge == m_Meetings[first].edge)
    {
      ++last;
    }
    UniteStraightest(core, balls, std::span(m_Meetings).subspan(first, last - first), sheets);
  }
  std::vector<Level> sheetLevels(m_Faces.size() + 1, 0);
  sheetLevels[sheets.Find(Staying())] = static_cast<Level>(highest);
  for (std::size_t face = 0; face < m_Faces.size(); ++face)
  {
    Level & sheet = sheetLevels[sheets.Find(face)];
    sheet = std::max(sheet, m_FaceLevels[face]);
  }
  for (ElementIndex face = 0; face < m_Faces.size(); ++face)
  {
    m_FaceLevels[face] = sheetLevels[sheets.Find(face)];
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
Strip::Collapse(const ToleranceLevels & levels, ToleranceValues & values)
{
  m_Turns.assign(levels.LevelOf(m_High) + 1, {});
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
Strip::RemoveEdge(ElementIndex edge, double height, ToleranceValues & values)
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
Strip::RemoveVertex(ElementIndex vertex, double height, ToleranceValues & values)
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

} // namespace

void
KeepSheetsWhole(const MedialComplex &         core,
                const std::vector<CoreBall> & balls,
                const ToleranceLevels &       levels,
                ToleranceValues &             values)
{
  Strip strip(core.cells, values, levels);
  if (strip.IsEmpty())
  {
    return;
  }
  strip.RaiseSheets(core, balls, levels.LevelOf(levels.Measured()));
  strip.Collapse(levels, values);
}

} // namespace voxelcore
