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

struct Facet
{
  std::array<std::size_t, 3> corners{};
  Vector3                    normal{}; ///< outwards, not of unit length
};

Facet
MakeFacet(const std::vector<Vector3> & points, std::size_t a, std::size_t b, std::size_t c)
{
  return { { a, b, c }, Cross(Minus(points[b], points[a]), Minus(points[c], points[a])) };
}

/** The farthest point by a measure. */
template <typename Measure>
std::size_t
Farthest(const std::vector<Vector3> & points, const Measure & measure)
{
  std::size_t best = 0;
  double      most = -1;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const double value = measure(points[i]);
    if (value > most)
    {
      most = value;
      best = i;
    }
  }
  return best;
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
  const std::size_t a = Farthest(points, [&](const Vector3 & p) { return Distance(p, points[0]); });
  const std::size_t b = Farthest(points, [&](const Vector3 & p) { return Distance(p, points[a]); });
  const double      size = Distance(points[a], points[b]);
  const Vector3     along = Minus(points[b], points[a]);
  const std::size_t c = Farthest(points, [&](const Vector3 & p) { return Length(Cross(along, Minus(p, points[a]))); });
  const Vector3     across = Cross(along, Minus(points[c], points[a]));
  const std::size_t d = Farthest(points, [&](const Vector3 & p) { return std::abs(Dot(across, Minus(p, points[a]))); });
  const double      height = Dot(across, Minus(points[d], points[a]));
  const double      tiny = 1e-12 * size * size * size;
  if (!(std::abs(height) > tiny))
  {
    return {};
  }
  std::vector<Facet> facets = height > 0 ? std::vector<Facet>{ MakeFacet(points, a, c, b),
                                                               MakeFacet(points, a, b, d),
                                                               MakeFacet(points, b, c, d),
                                                               MakeFacet(points, c, a, d) }
                                         : std::vector<Facet>{ MakeFacet(points, a, b, c),
                                                               MakeFacet(points, b, a, d),
                                                               MakeFacet(points, c, b, d),
                                                               MakeFacet(points, a, c, d) };
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const auto sees = [&](const Facet & facet) {
      return Dot(facet.normal, Minus(points[i], points[facet.corners[0]])) > tiny;
    };
    const auto firstSeen = std::partition(facets.begin(), facets.end(), [&](const Facet & f) { return !sees(f); });
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
      facets.push_back(MakeFacet(points, from, to, i));
    }
  }
  HullSize hull;
  for (const Facet & facet : facets)
  {
    hull.surface += Length(facet.normal) / 2;
    hull.volume += Dot(facet.normal, Minus(points[facet.corners[0]], points[a])) / 6;
  }
  return hull;
}

} // namespace voxelcore
