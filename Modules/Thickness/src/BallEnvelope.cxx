#include "BallEnvelope.h"

#include "voxelcore/TriangleTree.h"
#include "voxelcore/Vectors.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace voxelcore
{

namespace
{

/** How much of each corner a place in a triangle is made of; false for a triangle that is none. */
bool
SharesOf(const Vector3 & place, const std::array<Vector3, 3> & corners, std::array<double, 3> & shares)
{
  const Vector3 u = Minus(corners[1], corners[0]);
  const Vector3 v = Minus(corners[2], corners[0]);
  const Vector3 w = Minus(place, corners[0]);
  const double  uu = Dot(u, u);
  const double  uv = Dot(u, v);
  const double  vv = Dot(v, v);
  const double  area = uu * vv - uv * uv;
  if (!(area > 1e-12 * uu * vv))
  {
    return false;
  }
  shares[1] = (vv * Dot(w, u) - uv * Dot(w, v)) / area;
  shares[2] = (uu * Dot(w, v) - uv * Dot(w, u)) / area;
  shares[0] = 1 - shares[1] - shares[2];
  return true;
}

} // namespace

BallEnvelope::BallEnvelope(const CellComplex & cells, const PaintingBalls & balls, const SpacingWeights & weights)
  : m_Cells(cells)
  , m_Balls(balls)
  , m_Tree(balls.centres, balls.radius, weights)
  , m_Begin(cells.vertexCount + 1, 0)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    m_Sides[axis] = static_cast<double>(weights.weight[axis]) * weights.unit;
  }
  const std::vector<Cofaces> cofaces = CountEdgeCofaces(cells);
  const auto                 forAll = [&](auto && visit) {
    for (std::size_t face = 0; face < cells.FaceCount(); ++face)
    {
      for (const ElementIndex corner : cells.FaceVertices(face))
      {
        visit(corner, face);
      }
    }
    for (std::size_t edge = 0; edge < cells.edges.size(); ++edge)
    {
      for (std::size_t end = 0; end < 2 && cofaces[edge].count == 0; ++end)
      {
        visit(cells.edges[edge][end], cells.FaceCount() + edge);
      }
    }
  };
  forAll([&](ElementIndex vertex, std::size_t /* what */) { ++m_Begin[vertex + 1]; });
  std::partial_sum(m_Begin.begin(), m_Begin.end(), m_Begin.begin());
  m_At.resize(m_Begin.back());
  std::vector<std::uint64_t> next(m_Begin.begin(), m_Begin.end() - 1);
  forAll([&](ElementIndex vertex, std::size_t what) { m_At[next[vertex]++] = static_cast<ElementIndex>(what); });
}

NearestBall
BallEnvelope::Find(const Vector3 & given, std::size_t & likely) const
{
  NearestBall   found;
  const Vector3 place = Times(given, m_Sides);
  found.gap = m_Tree.Gap(given, -HUGE_VAL, likely);
  found.vertex = m_Tree.BallOf(likely);
  const auto at = [&](ElementIndex vertex) { return Times(m_Balls.centres[vertex], m_Sides); };
  Vector3    centre = at(found.vertex);
  const auto take = [&](const Vector3 & other, double radius) {
    const double gap = Distance(place, other) - radius;
    if (gap < found.gap)
    {
      found.gap = gap;
      centre = other;
    }
  };
  const auto & radius = m_Balls.radius;
  for (std::uint64_t i = m_Begin[found.vertex]; i < m_Begin[found.vertex + 1]; ++i)
  {
    if (m_At[i] >= m_Cells.FaceCount())
    {
      const auto &  ends = m_Cells.edges[m_At[i] - m_Cells.FaceCount()];
      const Vector3 from = at(ends[0]);
      const Vector3 along = Minus(at(ends[1]), from);
      const double  squared = Dot(along, along);
      const double  part = squared > 0 ? std::clamp(Dot(Minus(place, from), along) / squared, 0.0, 1.0) : 0.0;
      take(AddScaled(from, part, along), radius[ends[0]] + part * (radius[ends[1]] - radius[ends[0]]));
      continue;
    }
    const auto                   corners = m_Cells.FaceVertices(m_At[i]);
    const std::array<Vector3, 3> triangle{ at(corners[0]), at(corners[1]), at(corners[2]) };
    const Vector3                nearest = NearestOnTriangle(place, triangle);
    std::array<double, 3>        shares{};
    if (SharesOf(nearest, triangle, shares))
    {
      take(nearest, shares[0] * radius[corners[0]] + shares[1] * radius[corners[1]] + shares[2] * radius[corners[2]]);
    }
  }
  const Vector3 way = Minus(place, centre);
  const double  length = Length(way);
  found.distance = length;
  found.way = length > 0 ? AddScaled({ 0, 0, 0 }, 1 / length, way) : way;
  return found;
}

} // namespace voxelcore
