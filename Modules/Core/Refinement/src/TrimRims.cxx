#include "TrimRims.h"

#include "RimVertices.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/VoxelCore/ExtractPart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

namespace voxelcore
{

namespace
{

constexpr std::uint32_t kNone = 0xFFFFFFFF;

/** Which ball covers each boundary vertex, and whether it could do without some. */
class Cover
{
public:
  Cover(const std::vector<LatticePoint> & points,
        const ToleranceAt &               tolerance,
        CoveredBoundary                   covered,
        std::size_t                       balls)
    : m_Points(points)
    , m_Tolerance(tolerance)
    , m_Balls(std::move(covered.balls))
    , m_First(balls, kNone)
    , m_Next(points.size(), kNone)
    , m_Number(balls)
  {
    for (std::size_t point = points.size(); point-- > 0;)
    {
      if (covered.ball[point] != CoveredBoundary::kOpen)
      {
        Give(static_cast<std::uint32_t>(point), covered.ball[point]);
      }
    }
    for (std::size_t number = 0; number < balls; ++number)
    {
      m_Number[m_Balls.BallOf(number)] = number;
    }
  }

  /** Takes balls away, if what each of them covers lies within its tolerance of another one. */
  bool
  DoesWithout(std::span<const ElementIndex> balls, const std::vector<double> & radius)
  {
    for (const ElementIndex ball : balls)
    {
      m_Balls.SetRadius(m_Number[ball], -HUGE_VAL);
    }
    m_Others.clear();
    std::size_t nearest = 0;
    for (const ElementIndex ball : balls)
    {
      for (std::uint32_t point = m_First[ball]; point != kNone; point = m_Next[point])
      {
        const LatticePoint & p = m_Points[point];
        const Vector3        place{ static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z) };
        const double         most = m_Tolerance(point);
        if (m_Balls.Gap(place, most, nearest) > most)
        {
          for (const ElementIndex one : balls)
          {
            m_Balls.SetRadius(m_Number[one], radius[one]);
          }
          return false;
        }
        m_Others.emplace_back(point, m_Balls.BallOf(nearest));
      }
    }
    for (const auto & [point, other] : m_Others)
    {
      Give(point, other);
    }
    return true;
  }

private:
  void
  Give(std::uint32_t point, std::uint32_t ball)
  {
    m_Next[point] = m_First[ball];
    m_First[ball] = point;
  }

  const std::vector<LatticePoint> &                    m_Points;
  const ToleranceAt &                                  m_Tolerance;
  BallTree                                             m_Balls;
  std::vector<std::uint32_t>                           m_First;  ///< boundary vertex that each ball covers
  std::vector<std::uint32_t>                           m_Next;   ///< boundary vertex of the same ball
  std::vector<std::size_t>                             m_Number; ///< of each ball in the tree
  std::vector<std::pair<std::uint32_t, std::uint32_t>> m_Others; ///< what is covered by others
};

class Trimming
{
public:
  Trimming(const RefinementInput & input,
           const ToleranceAt &     tolerance,
           CoveredBoundary         covered,
           const RefinedCore &     refined)
    : m_Spacing(input.spacing)
    , m_Core(refined.core)
    , m_Cells(refined.core.cells)
    , m_Cover(input.Boundary(), tolerance, std::move(covered), m_Core.positions.size())
    , m_Live{ std::vector<std::uint8_t>(m_Cells.vertexCount, 1),
              std::vector<std::uint8_t>(m_Cells.edges.size(), 1),
              std::vector<std::uint8_t>(m_Cells.FaceCount(), 1) }
  {}

  /** Returns how many. */
  std::size_t
  TakeHairs()
  {
    const std::vector<Cofaces> facesAtEdges = CountEdgeCofaces(m_Cells);
    m_Lines.assign(m_Cells.vertexCount, {});
    for (ElementIndex edge = 0; edge < facesAtEdges.size(); ++edge)
    {
      for (const ElementIndex end : m_Cells.edges[edge])
      {
        if (facesAtEdges[edge].count == 0)
        {
          m_Lines[end].Add(edge);
        }
      }
    }
    m_IsOnFace.assign(m_Cells.vertexCount, 0);
    for (const ElementIndex corner : m_Cells.faceVertices)
    {
      m_IsOnFace[corner] = 1;
    }
    std::size_t hairs = 0;
    for (bool more = true; more;)
    {
      more = false;
      // What hangs on a hair that goes may be a longer one then, so all are looked for again.
      std::vector<std::pair<double, Hair>> found;
      for (ElementIndex tip = 0; tip < m_Cells.vertexCount; ++tip)
      {
        if (auto hair = HairAt(tip))
        {
          found.push_back(std::move(*hair));
        }
      }
      std::stable_sort(found.begin(), found.end(), [](const auto & a, const auto & b) { return a.first < b.first; });
      for (const auto & [length, hair] : found)
      {
        if (IsHair(hair) && m_Cover.DoesWithout(hair.vertices, m_Core.radius))
        {
          for (std::size_t i = 0; i < hair.vertices.size(); ++i)
          {
            m_Live.vertices[hair.vertices[i]] = m_Live.edges[hair.edges[i]] = 0;
            for (const ElementIndex end : m_Cells.edges[hair.edges[i]])
            {
              m_Lines[end].Remove(hair.edges[i]);
            }
          }
          ++hairs;
          more = true;
        }
      }
    }
    return hairs;
  }

  void
  TakeCorners()
  {
    constexpr int rounds = 8; // a corner that goes leaves corners
    for (int round = 0; round < rounds && TakeCornersOnce(); ++round)
    {}
  }

  LiveElements
  Take() &&
  {
    return std::move(m_Live);
  }

private:
  /** From its tip on; the edge after each vertex. */
  struct Hair
  {
    std::vector<ElementIndex> vertices;
    std::vector<ElementIndex> edges;
    ElementIndex              base = 0;
  };

  Vector3
  Place(ElementIndex vertex) const
  {
    return Times(m_Core.positions[vertex], m_Spacing);
  }

  std::optional<std::pair<double, Hair>>
  HairAt(ElementIndex tip) const
  {
    if (m_Live.vertices[tip] == 0 || m_IsOnFace[tip] != 0 || m_Lines[tip].count != 1)
    {
      return std::nullopt;
    }
    const double most = 2 * Length(m_Spacing);
    double       length = 0;
    Hair         hair;
    ElementIndex edge = m_Lines[tip].exclusiveOr;
    for (ElementIndex at = tip;;)
    {
      const auto &       ends = m_Cells.edges[edge];
      const ElementIndex next = ends[0] ^ ends[1] ^ at;
      hair.vertices.push_back(at);
      hair.edges.push_back(edge);
      length += Distance(Place(at), Place(next));
      if (!(length < most))
      {
        return std::nullopt;
      }
      if (m_IsOnFace[next] != 0 || m_Lines[next].count > 2)
      {
        hair.base = next;
        return std::pair{ length, std::move(hair) };
      }
      if (m_Lines[next].count < 2)
      {
        return std::nullopt; // all there is
      }
      edge ^= m_Lines[next].exclusiveOr;
      at = next;
    }
  }

  /** Where others have gone it may be a part of a line. */
  bool
  IsHair(const Hair & hair) const
  {
    return m_IsOnFace[hair.base] != 0 || m_Lines[hair.base].count > 2;
  }

  /** Whether the triangles about a vertex of a rim are one fan, each of which has another one beyond. */
  bool
  IsFan(const RimVertices & rims, std::size_t i) const
  {
    const ElementIndex vertex = rims.Vertex(i);
    const auto         faces = rims.Faces(i);
    ElementIndex       at = rims.Ends(i)[0];
    ElementIndex       last = kNone;
    std::size_t        count = 0;
    while (at != rims.Ends(i)[1])
    {
      const auto next = std::find_if(faces.begin(), faces.end(), [&](ElementIndex face) {
        const auto corners = m_Cells.FaceVertices(face);
        return face != last && std::find(corners.begin(), corners.end(), at) != corners.end();
      });
      if (next == faces.end())
      {
        return false;
      }
      last = *next;
      const auto corners = m_Cells.FaceVertices(last);
      const auto edges = m_Cells.FaceEdges(last);
      const auto k = static_cast<std::size_t>(std::find(corners.begin(), corners.end(), vertex) - corners.begin());
      at = corners[0] ^ corners[1] ^ corners[2] ^ vertex ^ at;
      const ElementIndex beyond = edges[(k + 1) % 3];
      const ElementIndex side =
        m_Cells.edges[edges[k]][0] == at || m_Cells.edges[edges[k]][1] == at ? edges[k] : edges[(k + 2) % 3];
      const bool isLast = at == rims.Ends(i)[1];
      if (rims.FacesAtEdges()[beyond] < 2 || rims.FacesAtEdges()[side] != (isLast ? 1U : 2U))
      {
        return false;
      }
      ++count;
    }
    return count == faces.size();
  }

  /** The angle of the triangles there, radians. */
  double
  AngleAt(const RimVertices & rims, std::size_t i) const
  {
    double sum = 0;
    for (const ElementIndex face : rims.Faces(i))
    {
      const ElementIndex     vertex = rims.Vertex(i);
      std::array<Vector3, 2> ways;
      std::size_t            k = 0;
      for (const ElementIndex corner : m_Cells.FaceVertices(face))
      {
        if (corner != vertex)
        {
          ways[k++] = Minus(Place(corner), Place(vertex));
        }
      }
      sum += std::atan2(Length(Cross(ways[0], ways[1])), Dot(ways[0], ways[1]));
    }
    return sum;
  }

  bool
  TakeCornersOnce()
  {
    constexpr double  widest = std::numbers::pi * 5 / 6; // what stands out; where a rim turns inwards there is more
    const RimVertices rims(m_Cells, m_Live.faces);
    std::vector<std::pair<double, std::size_t>> corners;
    for (std::size_t i = 0; i < rims.Count(); ++i)
    {
      const ElementIndex vertex = rims.Vertex(i);
      const double       turn = CosineOfTurn(Place(rims.Ends(i)[0]), Place(vertex), Place(rims.Ends(i)[1]));
      if (turn < kTornRim && m_Lines[vertex].count == 0 && IsFan(rims, i) && AngleAt(rims, i) < widest)
      {
        corners.emplace_back(turn, i);
      }
    }
    std::sort(corners.begin(), corners.end());
    std::vector<std::uint8_t> touched(m_Cells.vertexCount, 0);
    bool                      any = false;
    for (const auto & [turn, i] : corners)
    {
      const auto         faces = rims.Faces(i);
      const ElementIndex vertex = rims.Vertex(i);
      const auto         forCorners = [&](auto use) {
        for (const ElementIndex face : faces)
        {
          const auto at = m_Cells.FaceVertices(face);
          std::for_each(at.begin(), at.end(), use);
        }
      };
      bool isFree = true;
      forCorners([&](ElementIndex corner) { isFree = isFree && touched[corner] == 0; });
      if (!isFree || !m_Cover.DoesWithout({ &vertex, 1 }, m_Core.radius))
      {
        continue;
      }
      any = true;
      forCorners([&](ElementIndex corner) { touched[corner] = 1; });
      m_Live.vertices[vertex] = 0;
      for (const ElementIndex face : faces)
      {
        m_Live.faces[face] = 0;
        for (const ElementIndex edge : m_Cells.FaceEdges(face))
        {
          const auto & ends = m_Cells.edges[edge];
          m_Live.edges[edge] = ends[0] == vertex || ends[1] == vertex ? 0 : m_Live.edges[edge];
        }
      }
    }
    return any;
  }

  const Vector3             m_Spacing;
  const MedialComplex &     m_Core;
  const CellComplex &       m_Cells;
  Cover                     m_Cover;
  LiveElements              m_Live;
  std::vector<std::uint8_t> m_IsOnFace;
  std::vector<Cofaces>      m_Lines; ///< live edges on no face, by vertex
};

} // namespace

void
TrimRims(const RefinementInput & input, const ToleranceAt & tolerance, CoveredBoundary covered, RefinedCore & refined)
{
  LiveElements live;
  {
    Trimming trimming(input, tolerance, std::move(covered), refined);
    refined.hairsTaken = trimming.TakeHairs();
    trimming.TakeCorners();
    live = std::move(trimming).Take();
  }
  refined.kept.clear();
  for (ElementIndex vertex = 0; vertex < live.vertices.size(); ++vertex)
  {
    if (live.vertices[vertex] != 0)
    {
      refined.displacement[refined.kept.size()] = refined.displacement[vertex];
      refined.kept.push_back(vertex);
    }
  }
  if (refined.kept.size() < live.vertices.size())
  {
    refined.displacement.resize(refined.kept.size());
    std::size_t faces = 0;
    for (std::size_t face = 0; face < live.faces.size(); ++face)
    {
      refined.polygons[faces] = refined.polygons[face];
      faces += live.faces[face];
    }
    refined.polygons.resize(faces);
    refined.core = KeepPart(std::move(refined.core), live);
  }
}

} // namespace voxelcore
