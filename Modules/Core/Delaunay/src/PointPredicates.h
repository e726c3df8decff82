#pragma once
// The in-sphere test with a number type as wide as it needs.

#include "voxelcore/Lattice/LatticePoint.h"
#include "voxelcore/Lattice/Predicates.h"
#include "voxelcore/Lattice/SpacingWeights.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace voxelcore
{

/** Whether 64 bits hold the in-sphere values of these points. */
inline bool
FitsSmallIntegers(const std::vector<LatticePoint> & points, const SpacingWeights & weights)
{
  LatticePoint low = points.empty() ? LatticePoint{} : points[0];
  LatticePoint high = low;
  for (const LatticePoint & p : points)
  {
    low = { std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z) };
    high = { std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z) };
  }
  const std::int64_t extent =
    std::max({ std::int64_t{ high.x } - low.x, std::int64_t{ high.y } - low.y, std::int64_t{ high.z } - low.z });
  return InSphereBits(extent, weights) < 62.99;
}

/** Positive when p lies strictly inside the sphere of a tetrahedron of positive orientation, that is with
 *  det(b - a, c - a, d - a) > 0; 0 on it. TNumber holds the in-sphere value 72 w^2 N^5 (see Predicates.h). */
template <typename TNumber>
TNumber
InSphere(const std::array<LatticePoint, 4> & corners, const LatticePoint & p, const SpacingWeights & weights)
{
  std::array<std::int64_t, 4> x;
  std::array<std::int64_t, 4> y;
  std::array<std::int64_t, 4> z;
  std::array<TNumber, 4>      s;
  const auto &                w = weights.weight;
  for (std::size_t i = 0; i < 4; ++i)
  {
    x[i] = corners[i].x - p.x;
    y[i] = corners[i].y - p.y;
    z[i] = corners[i].z - p.z;
    s[i] = static_cast<TNumber>(w[0] * w[0]) * (x[i] * x[i]) + static_cast<TNumber>(w[1] * w[1]) * (y[i] * y[i]) +
           static_cast<TNumber>(w[2] * w[2]) * (z[i] * z[i]);
  }
  // Laplace along the pairs (0,1) and (2,3).
  const std::int64_t xy01 = x[0] * y[1] - x[1] * y[0], xy23 = x[2] * y[3] - x[3] * y[2];
  const std::int64_t xy02 = x[0] * y[2] - x[2] * y[0], xy13 = x[1] * y[3] - x[3] * y[1];
  const std::int64_t xy03 = x[0] * y[3] - x[3] * y[0], xy12 = x[1] * y[2] - x[2] * y[1];
  const auto         minor =
    [&](std::size_t a, std::size_t b, std::size_t c, std::int64_t bc, std::int64_t ac, std::int64_t ab) {
      return static_cast<TNumber>(z[a]) * bc - static_cast<TNumber>(z[b]) * ac + static_cast<TNumber>(z[c]) * ab;
    };
  const TNumber m0 = minor(1, 2, 3, xy23, xy13, xy12);
  const TNumber m1 = minor(0, 2, 3, xy23, xy03, xy02);
  const TNumber m2 = minor(0, 1, 3, xy13, xy03, xy01);
  const TNumber m3 = minor(0, 1, 2, xy12, xy02, xy01);
  return s[0] * m0 - s[1] * m1 + s[2] * m2 - s[3] * m3;
}

} // namespace voxelcore
