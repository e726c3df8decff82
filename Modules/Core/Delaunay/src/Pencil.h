#pragma once
// The spheres through a circle, by one parameter.

#include "voxelcore/Lattice/LatticePoint.h"
#include "voxelcore/Lattice/SpacingWeights.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace voxelcore
{

/** Weights in the forms that looks across facets ask for. */
struct MetricWeights
{
  std::array<std::int64_t, 3> squared{};
  std::array<double, 3>       single{};
  std::array<double, 3>       inverse{};
  std::array<double, 3>       inverseSquared{};
  double                      product = 1.0;
  double                      inverseProduct2 = 0.0; ///< 1 / product^2
  double                      least = 0.0;

  explicit MetricWeights(const SpacingWeights & weights)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      squared[i] = weights.weight[i] * weights.weight[i];
      single[i] = static_cast<double>(weights.weight[i]);
      inverse[i] = 1.0 / single[i];
      inverseSquared[i] = inverse[i] * inverse[i];
      product *= single[i];
    }
    inverseProduct2 = 1.0 / (product * product);
    least = std::min({ single[0], single[1], single[2] });
  }
};

/** All spheres through the circle of three lattice points a, b, c. A point q on the side the normal b - a x c - a
 *  points to (height > 0) lies on the sphere with parameter value(q) / height(q), and inside all those with a greater
 *  one; with m the circle's centre, D = |ab x ac|^2 and . the weighted product (q, m from a):
 *    height = det(ab, ac, q),   value = D (|q|^2 - 2 m.q) = D |q|^2 - vv (uu - uv) (u.q) - uu (vv - uv) (v.q).
 *  TNumber holds value * height: with differences up to 63 in a facet up to 30 w across (w the least weight, W
 *  the greatest), D <= (900 w^2)^2, |q|^2 <= 3 (63 W)^2, so value <= 3.0e10 w^4 W^2 and height <= 1.7e5: 2^53 for
 *  weights 1 (64 bits), 2^125 for weights up to 4096 (128 bits). */
template <typename TNumber>
struct Pencil
{
  LatticePoint                a{};
  std::array<std::int64_t, 3> normal{}; ///< of height
  std::array<TNumber, 3>      linear{}; ///< of value
  TNumber                     D = 0;
  std::array<double, 3>       middle{};    ///< the circle's centre
  std::array<double, 3>       along{};     ///< index step per unit of length along the normal
  double                      circle2 = 0; ///< squared radius of the circle
  double                      scale = 0; ///< distance of the sphere's centre from the circle's = scale * value / height

  Pencil(const LatticePoint & pa, const LatticePoint & pb, const LatticePoint & pc, const MetricWeights & weights)
    : a(pa)
    , m_Squared(weights.squared)
  {
    const std::array<std::int64_t, 3> u{ pb.x - pa.x, pb.y - pa.y, pb.z - pa.z };
    const std::array<std::int64_t, 3> v{ pc.x - pa.x, pc.y - pa.y, pc.z - pa.z };
    normal = { u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0] };
    TNumber uu = 0;
    TNumber uv = 0;
    TNumber vv = 0;
    for (std::size_t i = 0; i < 3; ++i)
    {
      uu += Squared(i) * (u[i] * u[i]);
      uv += Squared(i) * (u[i] * v[i]);
      vv += Squared(i) * (v[i] * v[i]);
    }
    D = uu * vv - uv * uv;
    const TNumber alpha = vv * (uu - uv);
    const TNumber beta = uu * (vv - uv);
    const auto    d = static_cast<double>(D);
    const double  half = 0.5 / d;
    const double  share = weights.product / std::sqrt(d);
    scale = 0.5 * share * weights.inverseProduct2;
    for (std::size_t i = 0; i < 3; ++i)
    {
      const TNumber across = alpha * u[i] + beta * v[i];
      linear[i] = Squared(i) * across;
      const double m = static_cast<double>(across) * half;
      middle[i] = m;
      circle2 += weights.single[i] * weights.single[i] * (m * m);
      along[i] = share * weights.inverseSquared[i] * static_cast<double>(normal[i]);
    }
    middle[0] += a.x;
    middle[1] += a.y;
    middle[2] += a.z;
  }

  std::int64_t
  Height(const LatticePoint & q) const
  {
    return normal[0] * (q.x - a.x) + normal[1] * (q.y - a.y) + normal[2] * (q.z - a.z);
  }
  TNumber
  Value(const LatticePoint & q) const
  {
    const std::int64_t x = q.x - a.x;
    const std::int64_t y = q.y - a.y;
    const std::int64_t z = q.z - a.z;
    return D * (Squared(0) * (x * x) + Squared(1) * (y * y) + Squared(2) * (z * z)) -
           (linear[0] * x + linear[1] * y + linear[2] * z);
  }

private:
  // 64 bits are for weights 1.
  TNumber
  Squared([[maybe_unused]] std::size_t axis) const
  {
    if constexpr (sizeof(TNumber) == 8)
    {
      return 1;
    }
    else
    {
      return m_Squared[axis];
    }
  }

  const std::array<std::int64_t, 3> & m_Squared;
};

} // namespace voxelcore
