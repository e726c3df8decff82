// Triangles beside a rim that went as a whole come back where their outer corners can be drawn in.

#include "MoveGuard.h"
#include "RefinementState.h"
#include "Rims.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace voxelcore
{

namespace
{

/** What is left of a complex, with the rims of its sheets: edges of one triangle. */
struct SheetsLeft
{
  SheetsLeft(const CellComplex & whole, const CorePart & part)
    : cells(whole)
    , live{ std::vector<std::uint8_t>(whole.vertexCount, 0),
            std::vector<std::uint8_t>(whole.edges.size(), 0),
            std::vector<std::uint8_t>(whole.FaceCount(), 0) }
    , facesAt(whole.edges.size(), 0)
    , onWide(whole.vertexCount, 0)
  {
    const std::vector<Cofaces>      facesAtEdges = CountEdgeCofaces(part.cells);
    const std::vector<std::uint8_t> wide = OnWideSheets(part.cells, facesAtEdges);
    for (std::size_t vertex = 0; vertex < part.vertices.size(); ++vertex)
    {
      live.vertices[part.vertices[vertex]] = 1;
      onWide[part.vertices[vertex]] = wide[vertex];
    }
    for (std::size_t edge = 0; edge < part.edges.size(); ++edge)
    {
      live.edges[part.edges[edge]] = 1;
      facesAt[part.edges[edge]] = static_cast<std::uint8_t>(std::min<ElementIndex>(facesAtEdges[edge].count, 3));
    }
    for (const ElementIndex face : part.faces)
    {
      live.faces[face] = 1;
    }
  }

  bool
  IsRim(ElementIndex edge) const
  {
    return facesAt[edge] == 1 && onWide[cells.edges[edge][0]] != 0 && onWide[cells.edges[edge][1]] != 0;
  }

  /** Whether a triangle that is not left hangs on one edge of a rim by two edges of its own, which end in a corner of
   *  its own, or on two by one edge of its own. What comes back so changes no topology. */
  bool
  CanComeBack(ElementIndex face) const
  {
    int rims = 0;
    int own = 0;
    int ownCorners = 0;
    for (const ElementIndex edge : cells.FaceEdges(face))
    {
      rims += live.edges[edge] != 0 && IsRim(edge) ? 1 : 0;
      own += live.edges[edge] == 0 ? 1 : 0;
    }
    for (const ElementIndex corner : cells.FaceVertices(face))
    {
      ownCorners += live.vertices[corner] == 0 ? 1 : 0;
    }
    return live.faces[face] == 0 && rims > 0 && own > 0 && rims + own == 3 && ownCorners == own - 1;
  }

  void
  TakeBack(ElementIndex face)
  {
    live.faces[face] = 1;
    for (const ElementIndex edge : cells.FaceEdges(face))
    {
      live.edges[edge] = 1;
      ++facesAt[edge];
    }
    for (const ElementIndex corner : cells.FaceVertices(face))
    {
      live.vertices[corner] = onWide[corner] = 1;
    }
  }

  const CellComplex &       cells;
  LiveElements              live;
  std::vector<std::uint8_t> facesAt; ///< of edges, up to 3 before any came back
  std::vector<std::uint8_t> onWide;  ///< OnWideSheets()
};

using VertexFaces = std::vector<std::pair<ElementIndex, ElementIndex>>; ///< in order

// Of vertices on rims, the faces that are left.
VertexFaces
FacesAtRims(const SheetsLeft & left)
{
  std::vector<std::uint8_t> onRim(left.cells.vertexCount, 0);
  for (ElementIndex edge = 0; edge < left.facesAt.size(); ++edge)
  {
    if (left.IsRim(edge))
    {
      onRim[left.cells.edges[edge][0]] = onRim[left.cells.edges[edge][1]] = 1;
    }
  }
  VertexFaces at;
  for (ElementIndex face = 0; face < left.live.faces.size(); ++face)
  {
    for (const ElementIndex corner : left.cells.FaceVertices(face))
    {
      if (left.live.faces[face] != 0 && onRim[corner] != 0)
      {
        at.emplace_back(corner, face);
      }
    }
  }
  std::sort(at.begin(), at.end());
  return at;
}

} // namespace

double
RefinementState::MeasureOfFace(ElementIndex face) const
{
  std::array<double, 3> widths{};
  for (std::size_t k = 0; k < 3; ++k)
  {
    widths[k] = m_Widths[m_CornerWidths[3 * std::size_t{ face } + k]];
  }
  return MeasureOf(widths);
}

// By 90 degrees or more, against what it was.
bool
RefinementState::HasTurned(ElementIndex face) const
{
  const auto             corners = m_Cells.FaceVertices(face);
  std::array<Vector3, 3> before;
  std::array<Vector3, 3> now;
  for (std::size_t k = 0; k < 3; ++k)
  {
    before[k] = Times(m_Positions[corners[k]], m_Input.spacing);
    now[k] = Place(corners[k]);
  }
  const auto normal = [](const std::array<Vector3, 3> & at) { return Cross(Minus(at[1], at[0]), Minus(at[2], at[0])); };
  return !(Dot(normal(before), normal(now)) > 0);
}

RefinementState::Corner
RefinementState::CornerAt(ElementIndex vertex) const
{
  const auto first = m_Widths.begin() + static_cast<std::ptrdiff_t>(m_Pairs.First(vertex));
  return { m_Displacement[vertex],
           m_Radius[vertex],
           m_Swelling[vertex],
           std::vector<double>(first, first + static_cast<std::ptrdiff_t>(Pairs(vertex).size())) };
}

void
RefinementState::Put(ElementIndex vertex, const Corner & corner)
{
  m_Displacement[vertex] = corner.displacement;
  m_Radius[vertex] = corner.radius;
  m_Swelling[vertex] = corner.swelling;
  std::copy(corner.widths.begin(),
            corner.widths.end(),
            m_Widths.begin() + static_cast<std::ptrdiff_t>(m_Pairs.First(vertex)));
}

// Draws a corner in towards `to`, mm, until its width in a triangle is the threshold, or as far as it may go.
void
RefinementState::DrawIn(const FootPointFinder & finder,
                        double                  threshold,
                        ElementIndex            vertex,
                        std::uint32_t           width,
                        const Vector3 &         to)
{
  constexpr int          halvings = 4;
  constexpr double       farthest = 0.9; // of the way: a triangle is left
  const Vector3          former = m_Displacement[vertex];
  const Vector3          way = Over(Minus(to, Place(vertex)), m_Input.spacing);
  const double           most = std::min(farthest, PartWithinAVoxel(former, way));
  std::vector<FootPoint> footPoints;
  const PointPair &      pair = m_Pairs.All()[width];
  const auto             goTo = [&](double part) {
    m_Displacement[vertex] = KeepInShape(*m_Input.shape, m_Positions[vertex], AddScaled(former, part, way));
  };
  const auto isAboveAt = [&](double part) {
    goTo(part);
    double apart = 0;
    double swelling = 0;
    MeasureAt(finder, Place(vertex), { &pair, 1 }, footPoints, { &apart, 1 }, swelling);
    return apart >= threshold;
  };
  double part = most;
  if (isAboveAt(part))
  {
    double step = 0.5 * most;
    for (int halving = 0; halving < halvings; ++halving)
    {
      part -= isAboveAt(part - step) ? step : 0;
      step *= 0.5;
    }
  }
  goTo(part);
  footPoints.clear();
  MoveVertex(finder, vertex, { &pair, 1 }, footPoints);
  footPoints.clear();
  MeasureVertex(finder, vertex, footPoints);
}

// Whether a triangle measures the threshold when its corners that measure less are drawn in towards the others, and
// nothing beside it measures too little or turns over then. Returns its corners through `drawn`, and leaves them as
// they were.
bool
RefinementState::DrawIn(const FootPointFinder & finder,
                        double                  threshold,
                        ElementIndex            face,
                        const FacesAt &         facesAt,
                        std::array<Corner, 3> & drawn)
{
  const auto             corners = m_Cells.FaceVertices(face);
  std::array<Corner, 3>  former{ CornerAt(corners[0]), CornerAt(corners[1]), CornerAt(corners[2]) };
  std::array<bool, 3>    isAbove{};
  Vector3                sum{ 0, 0, 0 };
  int                    above = 0;
  std::vector<FootPoint> footPoints;
  for (std::size_t k = 0; k < 3; ++k)
  {
    if (facesAt(corners[k]).empty()) // it is measured where it is, as it will be when it is back
    {
      footPoints.clear();
      MeasureVertex(finder, corners[k], footPoints);
    }
    isAbove[k] = m_Widths[m_CornerWidths[3 * std::size_t{ face } + k]] >= threshold;
    sum = isAbove[k] ? AddScaled(sum, 1, Place(corners[k])) : sum;
    above += isAbove[k] ? 1 : 0;
  }
  bool fits = above > 0;
  for (std::size_t k = 0; fits && k < 3; ++k)
  {
    if (isAbove[k])
    {
      continue;
    }
    std::vector<std::pair<ElementIndex, double>> beside;
    for (const auto & [vertex, other] : facesAt(corners[k]))
    {
      beside.emplace_back(other, std::min(threshold, MeasureOfFace(other)));
    }
    DrawIn(finder,
           threshold,
           corners[k],
           m_CornerWidths[3 * std::size_t{ face } + k],
           AddScaled({ 0, 0, 0 }, 1.0 / above, sum));
    fits = std::all_of(beside.begin(), beside.end(), [&](const auto & other) {
      return MeasureOfFace(other.first) >= other.second && !HasTurned(other.first);
    });
  }
  fits = fits && MeasureOfFace(face) >= threshold && !HasTurned(face);
  for (std::size_t k = 0; k < 3; ++k)
  {
    drawn[k] = CornerAt(corners[k]);
    Put(corners[k], former[k]);
  }
  return fits;
}

// A rim vertex may go on by a voxel at most, while triangles are up to several voxels long. So those that were not
// left, hang on a rim and measure enough at one corner at least come back with the others drawn in. Returns what was
// moved or is new, which is measured where it is.
std::vector<ElementIndex>
RefinementState::TakeBackAtRims(const FootPointFinder & finder, CorePart & part, double threshold)
{
  constexpr int             passes = 12; // neighbours come back one after the other
  SheetsLeft                left(m_Cells, part);
  std::vector<std::uint8_t> hasFailed(m_Cells.FaceCount(), 0);
  std::vector<std::uint8_t> changed(m_Cells.vertexCount, 0);
  struct Lost
  {
    ElementIndex          face = 0;
    double                far = 0; ///< how far in all its corners were drawn in
    std::array<Corner, 3> corners{};
  };
  for (int pass = 0; pass < passes; ++pass)
  {
    const VertexFaces rims = FacesAtRims(left);
    const FacesAt     facesAt = [&](ElementIndex vertex) {
      const auto from = std::lower_bound(rims.begin(), rims.end(), std::pair{ vertex, ElementIndex{ 0 } });
      const auto to = std::find_if(from, rims.end(), [&](const auto & one) { return one.first != vertex; });
      return std::span(rims.data() + (from - rims.begin()), static_cast<std::size_t>(to - from));
    };
    std::vector<Lost> lost;
    for (ElementIndex face = 0; face < m_Cells.FaceCount(); ++face)
    {
      if (hasFailed[face] != 0 || !left.CanComeBack(face))
      {
        continue;
      }
      Lost one{ face, 0, {} };
      if (!DrawIn(finder, threshold, face, facesAt, one.corners))
      {
        hasFailed[face] = 1;
        continue;
      }
      for (std::size_t k = 0; k < 3; ++k)
      {
        one.far += Distance(one.corners[k].displacement, m_Displacement[m_Cells.FaceVertices(face)[k]]);
      }
      lost.push_back(std::move(one));
    }
    std::stable_sort(lost.begin(), lost.end(), [](const Lost & a, const Lost & b) { return a.far < b.far; });
    std::vector<std::uint8_t> touched(m_Cells.vertexCount, 0);
    bool                      more = false;
    for (const Lost & one : lost)
    {
      const auto corners = m_Cells.FaceVertices(one.face);
      if (!left.CanComeBack(one.face) ||
          std::any_of(corners.begin(), corners.end(), [&](ElementIndex corner) { return touched[corner] != 0; }))
      {
        continue;
      }
      for (std::size_t k = 0; k < 3; ++k)
      {
        touched[corners[k]] = 1;
        if (left.live.vertices[corners[k]] == 0 || m_Displacement[corners[k]] != one.corners[k].displacement)
        {
          changed[corners[k]] = 1;
        }
        Put(corners[k], one.corners[k]);
      }
      left.TakeBack(one.face);
      more = true;
    }
    if (!more)
    {
      break;
    }
  }
  part = PartOf(m_Cells, left.live);
  std::vector<ElementIndex> moved;
  for (ElementIndex vertex = 0; vertex < changed.size(); ++vertex)
  {
    if (changed[vertex] != 0)
    {
      moved.push_back(vertex);
    }
  }
  return moved;
}

} // namespace voxelcore
