#include "ConvexHull.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>

namespace voxelcore
{

namespace
{

using Whole = std::array<std::int64_t, 3>;
__extension__ using Wide = __int128;

struct Facet
{
  std::array<std::size_t, 3> corners{};
  Whole                      normal{}; ///< outwards, not of unit length
};

Whole
WholeMinus(const Whole & a, const Whole & b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

Whole
WholeCross(const Whole & a, const Whole & b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

Wide
WholeDot(const Whole & a, const Whole & b)
{
  return Wide{ a[0] } * b[0] + Wide{ a[1] } * b[1] + Wide{ a[2] } * b[2];
}

/** Scattered bits of a number (splitmix64). */
std::uint64_t
Scattered(std::uint64_t x)
{
  x += 0x9E3779B97F4A7C15U;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9U;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBU;
  return x ^ (x >> 31);
}

/** Points as whole numbers up to 2^29, each moved by up to 2^8: no four lie in a plane, and no sign is in doubt. */
std::vector<Whole>
WholePoints(const std::vector<Vector3> & points)
{
  Vector3 least = points.front();
  Vector3 most = points.front();
  for (const Vector3 & point : points)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      least[axis] = std::min(least[axis], point[axis]);
      most[axis] = std::max(most[axis], point[axis]);
    }
  }
  const double       side = std::max({ most[0] - least[0], most[1] - least[1], most[2] - least[2], 1e-300 });
  std::vector<Whole> whole(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const auto moved = static_cast<std::int64_t>(Scattered(3 * i + axis) % 513) - 256;
      whole[i][axis] = std::llround((points[i][axis] - least[axis]) / side * 0x1p29) + moved;
    }
  }
  return whole;
}

Facet
MakeFacet(const std::vector<Whole> & points, std::size_t a, std::size_t b, std::size_t c)
{
  return { { a, b, c }, WholeCross(WholeMinus(points[b], points[a]), WholeMinus(points[c], points[a])) };
}

} // namespace

HullSize
ConvexHullSize(const std::vector<Vector3> & points)
{
  if (points.size() < 4)
  {
    return {};
  }
  // A tetrahedron to begin with, then point by point: facets that see it go, and it is joined to their rim.
  const std::vector<Whole> whole = WholePoints(points);
  Facet                    base = MakeFacet(whole, 0, 1, 2);
  std::size_t              apex = 3;
  while (apex < whole.size() && WholeDot(base.normal, WholeMinus(whole[apex], whole[0])) == 0)
  {
    ++apex;
  }
  if (apex == whole.size())
  {
    return {};
  }
  if (WholeDot(base.normal, WholeMinus(whole[apex], whole[0])) > 0)
  {
    base = MakeFacet(whole, 0, 2, 1);
  }
  std::vector<Facet> facets{ base };
  for (std::size_t k = 0; k < 3; ++k)
  {
    facets.push_back(MakeFacet(whole, base.corners[(k + 1) % 3], base.corners[k], apex));
  }
  for (std::size_t i = 3; i < whole.size(); ++i)
  {
    const auto hidden = [&](const Facet & facet) {
      return WholeDot(facet.normal, WholeMinus(whole[i], whole[facet.corners[0]])) <= 0;
    };
    const auto firstSeen = std::partition(facets.begin(), facets.end(), hidden);
    if (firstSeen == facets.end())
    {
      continue;
    }
    std::set<std::pair<std::size_t, std::size_t>> rim;
    for (auto facet = firstSeen; facet != facets.end(); ++facet)
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
    facets.erase(firstSeen, facets.end());
    for (const auto & [from, to] : rim)
    {
      facets.push_back(MakeFacet(whole, from, to, i));
    }
  }
  HullSize hull;
  for (const Facet & facet : facets)
  {
    const Vector3 & a = points[facet.corners[0]];
    const Vector3   normal =
      voxelcore::Cross(voxelcore::Minus(points[facet.corners[1]], a), voxelcore::Minus(points[facet.corners[2]], a));
    hull.surface += Length(normal) / 2;
    hull.volume += voxelcore::Dot(normal, voxelcore::Minus(a, points[0])) / 6;
  }
  return hull;
}

} // namespace voxelcore
