#include "CellHull.h"

#include "voxelcore/Error.h"

#include <algorithm>
#include <array>

namespace voxelcore
{

namespace
{

struct Vector
{
  std::int64_t x, y, z;
};

Vector
Between(const LatticePoint & from, const LatticePoint & to)
{
  return { std::int64_t{ to.x } - from.x, std::int64_t{ to.y } - from.y, std::int64_t{ to.z } - from.z };
}

Vector
Cross(const Vector & a, const Vector & b)
{
  return { a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

std::int64_t
Dot(const Vector & a, const Vector & b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

// The facet whose outline runs from point `from` to point `to`: pivot a plane about that side until all points lie
// behind it, then take every point on it, in order around `from`.
void
AppendFacet(std::span<const LatticePoint> points, std::uint16_t from, std::uint16_t to, HullFacets & hull)
{
  const Vector  side = Between(points[from], points[to]);
  std::uint16_t third = from;
  Vector        normal{ 0, 0, 0 };
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (i == from || i == to)
    {
      continue;
    }
    const Vector arm = Between(points[from], points[i]);
    if (third == from || Dot(normal, arm) > 0)
    {
      third = static_cast<std::uint16_t>(i);
      normal = Cross(side, arm);
    }
  }
  const std::size_t start = hull.corners.size();
  hull.corners.push_back(from);
  hull.corners.push_back(to);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (i != from && i != to && Dot(normal, Between(points[from], points[i])) == 0)
    {
      hull.corners.push_back(static_cast<std::uint16_t>(i));
    }
  }
  // All lie on the left of from -> to in the facet's plane, so angles about `from` are less than half a turn.
  std::sort(hull.corners.begin() + static_cast<std::ptrdiff_t>(start) + 2,
            hull.corners.end(),
            [&](std::uint16_t a, std::uint16_t b) {
              return Dot(Cross(Between(points[from], points[a]), Between(points[from], points[b])), normal) > 0;
            });
  hull.offsets.push_back(static_cast<std::uint16_t>(hull.corners.size()));
}

// A directed side of the hull at point 0 to start from: every cospherical point is a corner, so some plane through
// point 0 and two others has all points behind it.
std::array<std::uint16_t, 2>
FirstSide(std::span<const LatticePoint> points)
{
  for (std::uint16_t i = 1; i < points.size(); ++i)
  {
    for (std::uint16_t j = 1; j < points.size(); ++j)
    {
      const Vector normal = Cross(Between(points[0], points[i]), Between(points[0], points[j]));
      if (i != j && (normal.x != 0 || normal.y != 0 || normal.z != 0) &&
          std::all_of(points.begin(), points.end(), [&](const LatticePoint & p) {
            return Dot(normal, Between(points[0], p)) <= 0;
          }))
      {
        // The facet's outline through point 0: pivoting about a chord of it would miss part of the facet, so take the
        // point in its plane that is first in counter-clockwise order.
        std::uint16_t first = i;
        for (std::uint16_t k = 1; k < points.size(); ++k)
        {
          const Vector arm = Between(points[0], points[k]);
          if (Dot(normal, arm) == 0 && Dot(Cross(Between(points[0], points[first]), arm), normal) < 0)
          {
            first = k;
          }
        }
        return { 0, first };
      }
    }
  }
  throw Error("a Delaunay cell is flat; please report this input");
}

} // namespace

HullFacets
ComputeHull(std::span<const LatticePoint> points)
{
  HullFacets hull;
  // Gift wrapping: sides of known facets whose other facet is still missing.
  std::vector<std::array<std::uint16_t, 2>> open{ FirstSide(points) };
  std::swap(open[0][0], open[0][1]); // as if the facet beyond had run the other way
  while (!open.empty())
  {
    const std::array<std::uint16_t, 2> side{ open.back()[1], open.back()[0] };
    open.pop_back();
    AppendFacet(points, side[0], side[1], hull);
    const auto polygon = hull.Polygon(hull.Count() - 1);
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
      const std::array<std::uint16_t, 2> own{ polygon[i], polygon[(i + 1) % polygon.size()] };
      const std::array<std::uint16_t, 2> twin{ own[1], own[0] };
      if (own == side && hull.Count() > 1) // the facet on its other side is where it came from
      {
        continue;
      }
      const auto met = std::find(open.begin(), open.end(), twin);
      if (met != open.end())
      {
        *met = open.back();
        open.pop_back();
      }
      else
      {
        open.push_back(own);
      }
    }
    if (hull.Count() > 2 * points.size())
    {
      throw Error("the hull of a Delaunay cell does not close; please report this input");
    }
  }
  return hull;
}

const HullFacets &
HullMemo::Get(std::span<const LatticePoint> points)
{
  m_Key.clear();
  for (const LatticePoint & p : points)
  {
    const LatticePoint & o = points[0];
    m_Key.push_back(static_cast<char32_t>(((p.x - o.x + 64) << 14) | ((p.y - o.y + 64) << 7) | (p.z - o.z + 64)));
  }
  const auto found = m_Hulls.find(m_Key);
  if (found != m_Hulls.end())
  {
    return found->second;
  }
  // Large sets do not come back, and the table must not outgrow the caches.
  constexpr std::size_t largestKept = 12;
  constexpr std::size_t mostKept = 200000;
  if (points.size() > largestKept || m_Hulls.size() >= mostKept)
  {
    m_Last = ComputeHull(points);
    return m_Last;
  }
  return m_Hulls.emplace(m_Key, ComputeHull(points)).first->second;
}

} // namespace voxelcore
