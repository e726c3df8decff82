#include "FacetMeasure.h"

#include "voxelcore/Lattice/Predicates.h"

#include <cstdlib>

namespace voxelcore
{

namespace
{

// The longest side of a polygon by its first corner, and its squared length.
template <typename TLength>
struct LongestSide
{
  std::size_t from = 0;
  TLength     length = -1;
};

template <typename TLength, typename TSquaredDistance>
LongestSide<TLength>
FindLongestSide(const std::vector<LatticePoint> & polygon, TSquaredDistance squaredDistance)
{
  LongestSide<TLength> longest;
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    const TLength side = squaredDistance(polygon[i], polygon[i + 1 == polygon.size() ? 0 : i + 1]);
    if (side > longest.length)
    {
      longest = { i, side };
    }
  }
  return longest;
}

// Points of a facet lie on a circle. Its centre is in their hull unless the longest side sees another point under an
// obtuse angle; then that side's midpoint is the nearest point of the hull, and the smallest ball sits there.
double
MeasureAnyFacet(const std::vector<LatticePoint> & polygon, const SpacingWeights & weights)
{
  const std::size_t    n = polygon.size();
  const auto           longest = FindLongestSide<Int128>(polygon, [&](const LatticePoint & p, const LatticePoint & q) {
    return SquaredDistance(p, q, weights);
  });
  const LatticePoint & a = polygon[longest.from];
  const LatticePoint & b = polygon[(longest.from + 1) % n];
  const LatticePoint & c = polygon[(longest.from + 2) % n];
  if (AngleSign(c, a, b, weights) <= 0)
  {
    return RatioToDouble(static_cast<UInt128>(longest.length), 4);
  }
  return SquaredCircumradius(a, b, c, weights);
}

// The same for facets that are small, as most are: numerators stay below 2^53, so that one division of
// doubles rounds as RatioToDouble() does. False for others.
bool
MeasureSmallFacet(const std::vector<LatticePoint> & polygon, const SpacingWeights & weights, double & measure)
{
  constexpr std::int64_t farthest = std::int64_t{ 1 } << 17; // squared; three of them and 2 bits are 53
  std::int32_t           reach = 0;
  for (const LatticePoint & p : polygon)
  {
    reach |= std::abs(p.x - polygon[0].x) | std::abs(p.y - polygon[0].y) | std::abs(p.z - polygon[0].z);
  }
  if (reach >= 256)
  {
    return false;
  }
  const auto &                      w = weights.weight;
  const std::array<std::int64_t, 3> squaredWeights{ w[0] * w[0], w[1] * w[1], w[2] * w[2] };
  const auto dot = [&](const LatticePoint & from, const LatticePoint & p, const LatticePoint & q) {
    return squaredWeights[0] * ((p.x - from.x) * (q.x - from.x)) +
           squaredWeights[1] * ((p.y - from.y) * (q.y - from.y)) +
           squaredWeights[2] * ((p.z - from.z) * (q.z - from.z));
  };
  const auto longest = FindLongestSide<std::int64_t>(polygon, [&](const LatticePoint & p, const LatticePoint & q) {
    return dot(p, q, q);
  });
  if (longest.length >= farthest)
  {
    return false;
  }
  const auto           following = [&](std::size_t i) { return i + 1 == polygon.size() ? 0 : i + 1; };
  const std::size_t    second = following(longest.from);
  const LatticePoint & a = polygon[longest.from];
  const LatticePoint & b = polygon[second];
  const LatticePoint & c = polygon[following(second)];
  const std::int64_t   angle = dot(c, a, b);
  if (angle <= 0)
  {
    measure = static_cast<double>(longest.length) / 4.0;
    return true;
  }
  const std::int64_t uu = longest.length;
  const std::int64_t vv = dot(a, c, c);
  const std::int64_t ww = dot(b, c, c);
  if (vv >= farthest)
  {
    return false;
  }
  // |c - a|^2 |c - b|^2 - ((a - c).(b - c))^2 is the squared area of the parallelogram, from whichever corner.
  measure = static_cast<double>(uu * vv * ww) / static_cast<double>(4 * (vv * ww - angle * angle));
  return true;
}

} // namespace

double
MeasureFacet(const std::vector<LatticePoint> & polygon, const SpacingWeights & weights)
{
  double measure = 0.0;
  return MeasureSmallFacet(polygon, weights, measure) ? measure : MeasureAnyFacet(polygon, weights);
}

} // namespace voxelcore
