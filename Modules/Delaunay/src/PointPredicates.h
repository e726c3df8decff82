#pragma once
// Orientation and in-sphere tests over a list of points, with a number type as wide as they need.

#include "voxelcore/LatticePoint.h"
#include "voxelcore/Predicates.h"
#include "voxelcore/SpacingWeights.h"

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

/** TNumber holds the in-sphere value 72 w^2 N^5 (see Predicates.h). */
template <typename TNumber>
class PointPredicates
{
public:
  PointPredicates(std::vector<LatticePoint> points, const SpacingWeights & weights)
    : m_Points(std::move(points))
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      m_Squared[axis] = weights.weight[axis] * weights.weight[axis];
    }
  }

  std::size_t
  Size() const
  {
    return m_Points.size();
  }
  const LatticePoint &
  operator[](std::size_t i) const
  {
    return m_Points[i];
  }

  TNumber
  Orient(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const
  {
    const LatticePoint & o = m_Points[d];
    const std::int64_t   ax = m_Points[a].x - o.x, ay = m_Points[a].y - o.y, az = m_Points[a].z - o.z;
    const std::int64_t   bx = m_Points[b].x - o.x, by = m_Points[b].y - o.y, bz = m_Points[b].z - o.z;
    const std::int64_t   cx = m_Points[c].x - o.x, cy = m_Points[c].y - o.y, cz = m_Points[c].z - o.z;
    // det(b - a, c - a, d - a) = -det(a - d, b - d, c - d)
    return -(static_cast<TNumber>(ax) * (by * cz - bz * cy) + static_cast<TNumber>(ay) * (bz * cx - bx * cz) +
             static_cast<TNumber>(az) * (bx * cy - by * cx));
  }

  // Positive when p lies strictly inside the sphere of the positive tetrahedron.
  TNumber
  InSphere(const std::array<std::uint32_t, 4> & t, std::uint32_t point) const
  {
    const LatticePoint & p = m_Points[point];
    std::int64_t         x[4];
    std::int64_t         y[4];
    std::int64_t         z[4];
    TNumber              s[4];
    for (std::size_t i = 0; i < 4; ++i)
    {
      const LatticePoint & q = m_Points[t[i]];
      x[i] = q.x - p.x;
      y[i] = q.y - p.y;
      z[i] = q.z - p.z;
      s[i] = static_cast<TNumber>(m_Squared[0]) * (x[i] * x[i]) + static_cast<TNumber>(m_Squared[1]) * (y[i] * y[i]) +
             static_cast<TNumber>(m_Squared[2]) * (z[i] * z[i]);
    }
    // Laplace along the pairs (0,1) and (2,3).
    const std::int64_t xy01 = x[0] * y[1] - x[1] * y[0], xy23 = x[2] * y[3] - x[3] * y[2];
    const std::int64_t xy02 = x[0] * y[2] - x[2] * y[0], xy13 = x[1] * y[3] - x[3] * y[1];
    const std::int64_t xy03 = x[0] * y[3] - x[3] * y[0], xy12 = x[1] * y[2] - x[2] * y[1];
    const auto         minor = [&](int a, int b, int c, std::int64_t bc, std::int64_t ac, std::int64_t ab) {
      return static_cast<TNumber>(z[a]) * bc - static_cast<TNumber>(z[b]) * ac + static_cast<TNumber>(z[c]) * ab;
    };
    const TNumber m0 = minor(1, 2, 3, xy23, xy13, xy12);
    const TNumber m1 = minor(0, 2, 3, xy23, xy03, xy02);
    const TNumber m2 = minor(0, 1, 3, xy13, xy03, xy01);
    const TNumber m3 = minor(0, 1, 2, xy12, xy02, xy01);
    return s[0] * m0 - s[1] * m1 + s[2] * m2 - s[3] * m3;
  }

private:
  std::vector<LatticePoint>   m_Points;
  std::array<std::int64_t, 3> m_Squared{};
};

} // namespace voxelcore
