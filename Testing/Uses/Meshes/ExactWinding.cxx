#include "ExactWinding.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace voxelcore::testing
{
namespace
{

using Integer = boost::multiprecision::cpp_int;

constexpr int kShift = 400;       // e is 2^-400
constexpr int kUnit = 3 * kShift; // one is 2^1200 units, so that e^3 is 1

/** Finite doubles down to 2^-1100 are whole numbers of units. */
Integer
Units(double value)
{
  int          exponent = 0;
  const double fraction = std::frexp(value, &exponent);
  Integer      whole(static_cast<std::int64_t>(std::ldexp(fraction, 53)));
  const int    shift = kUnit + exponent - 53;
  if (shift < 0)
  {
    throw std::logic_error("a coordinate of a test is too small");
  }
  whole <<= shift;
  return whole;
}

/** Twice the signed area of three points, seen along an axis. */
Integer
Area(const std::array<Integer, 3> & a,
     const std::array<Integer, 3> & b,
     const std::array<Integer, 3> & c,
     std::size_t                    u,
     std::size_t                    v)
{
  return (b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u]);
}

} // namespace

ExactWinding::ExactWinding(const TriangleMesh & mesh, const VoxelGrid & grid)
  : m_Mesh(mesh)
  , m_Grid(grid)
{
  for (const Vector3 & point : mesh.points)
  {
    m_Points.push_back({ Units(point[0]), Units(point[1]), Units(point[2]) });
  }
}

ExactWinding::Point
ExactWinding::MovedCentre(const std::array<std::int32_t, 3> & index) const
{
  Point point;
  for (std::size_t a = 0; a < 3; ++a)
  {
    point[a] = Units(m_Grid.origin[a]) + (2 * index[a] + 1) * Units(m_Grid.spacing[a] / 2) +
               (Integer(1) << (kUnit - kShift * (static_cast<int>(a) + 1)));
  }
  return point;
}

int
ExactWinding::At(const std::array<std::int32_t, 3> & index, std::size_t axis) const
{
  const std::size_t u = (axis + 1) % 3;
  const std::size_t v = (axis + 2) % 3;
  const Point       centre = MovedCentre(index);
  const auto        rough = [&](std::size_t a) { return m_Grid.origin[a] + (index[a] + 0.5) * m_Grid.spacing[a]; };
  int               winding = 0;
  for (const auto & t : m_Mesh.triangles)
  {
    // Far off by a margin that no rounding reaches.
    bool isFar = false;
    for (const std::size_t a : { u, v })
    {
      const auto [low, high] = std::minmax({ m_Mesh.points[t[0]][a], m_Mesh.points[t[1]][a], m_Mesh.points[t[2]][a] });
      const double margin = 1e-6 * (1 + std::abs(low) + std::abs(high) + std::abs(rough(a)));
      isFar = isFar || rough(a) < low - margin || rough(a) > high + margin;
    }
    if (isFar)
    {
      continue;
    }
    const Point & a = m_Points[t[0]];
    const Point & b = m_Points[t[1]];
    const Point & c = m_Points[t[2]];
    const Integer wa = Area(centre, b, c, u, v);
    const Integer wb = Area(a, centre, c, u, v);
    const Integer wc = Area(a, b, centre, u, v);
    const Integer area = wa + wb + wc;
    const int     sign = area.sign();
    if (sign == 0)
    {
      continue;
    }
    if (wa.is_zero() || wb.is_zero() || wc.is_zero())
    {
      throw std::logic_error("a moved centre lies over an edge");
    }
    if (wa.sign() != sign || wb.sign() != sign || wc.sign() != sign)
    {
      continue;
    }
    // Height of the triangle over the centre, times the area.
    const Integer height = wa * a[axis] + wb * b[axis] + wc * c[axis] - area * centre[axis];
    if (height.is_zero())
    {
      throw std::logic_error("a moved centre lies on a triangle");
    }
    winding += height.sign() == sign ? sign : 0;
  }
  return winding;
}

} // namespace voxelcore::testing
