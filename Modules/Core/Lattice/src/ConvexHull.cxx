#include "voxelcore/Lattice/ConvexHull.h"

#include <algorithm>
#include <set>
#include <utility>

namespace voxelcore
{

namespace
{

using Point = std::array<std::int64_t, 3>;
__extension__ using Wide = __int128;

Point
Minus(const Point & a, const Point & b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

Point
Cross(const Point & a, const Point & b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

Wide
Dot(const Point & a, const Point & b)
{
  return Wide{ a[0] } * b[0] + Wide{ a[1] } * b[1] + Wide{ a[2] } * b[2];
}

HullFacet
MakeFacet(const std::vector<Point> & points, std::size_t a, std::size_t b, std::size_t c)
{
  return { { a, b, c }, Cross(Minus(points[b], points[a]), Minus(points[c], points[a])) };
}

/** Above 0 for points beyond the facet's plane. */
Wide
Above(const std::vector<Point> & points, const HullFacet & facet, std::size_t point)
{
  return Dot(facet.normal, Minus(points[point], points[facet.corners[0]]));
}

/** A tetrahedron of four of the points; none where they lie in a plane. */
std::vector<HullFacet>
FirstTetrahedron(const std::vector<Point> & points)
{
  const auto find = [&](auto && fits) {
    std::size_t i = 0;
    while (i < points.size() && !fits(i))
    {
      ++i;
    }
    return i;
  };
  const std::size_t b = find([&](std::size_t i) { return points[i] != points[0]; });
  if (b == points.size())
  {
    return {};
  }
  const std::size_t c = find([&](std::size_t i) { return MakeFacet(points, 0, b, i).normal != Point{ 0, 0, 0 }; });
  if (c == points.size())
  {
    return {};
  }
  HullFacet         base = MakeFacet(points, 0, b, c);
  const std::size_t apex = find([&](std::size_t i) { return Above(points, base, i) != 0; });
  if (apex == points.size())
  {
    return {};
  }
  if (Above(points, base, apex) > 0)
  {
    base = MakeFacet(points, 0, c, b);
  }
  std::vector<HullFacet> facets{ base };
  for (std::size_t k = 0; k < 3; ++k)
  {
    facets.push_back(MakeFacet(points, base.corners[(k + 1) % 3], base.corners[k], apex));
  }
  return facets;
}

} // namespace

std::vector<HullFacet>
ConvexHull(const std::vector<Point> & points)
{
  if (points.empty())
  {
    return {};
  }
  // Of a point outside, all facets go that see it or whose plane it lies in, and it is joined to the rim of the others:
  // so no new facet is flat, and whole faces are made anew when they grow.
  std::vector<HullFacet> facets = FirstTetrahedron(points);
  for (std::size_t i = 0; i < points.size() && !facets.empty(); ++i)
  {
    if (std::none_of(facets.begin(), facets.end(), [&](const HullFacet & f) { return Above(points, f, i) > 0; }))
    {
      continue;
    }
    const auto firstGone = std::partition(facets.begin(), facets.end(), [&](const HullFacet & facet) {
      return Above(points, facet, i) < 0;
    });
    std::set<std::pair<std::size_t, std::size_t>> rim;
    for (auto facet = firstGone; facet != facets.end(); ++facet)
    {
      for (std::size_t k = 0; k < 3; ++k)
      {
        const std::pair edge(facet->corners[k], facet->corners[(k + 1) % 3]);
        if (rim.erase({ edge.second, edge.first }) == 0)
        {
          rim.insert(edge);
        }
      }
    }
    facets.erase(firstGone, facets.end());
    for (const auto & [from, to] : rim)
    {
      facets.push_back(MakeFacet(points, from, to, i));
    }
  }
  return facets;
}

} // namespace voxelcore
