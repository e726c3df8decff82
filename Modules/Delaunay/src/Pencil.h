#pragma once
// The spheres through a circle, by one parameter.

#include "voxelcore/LatticePoint.h"
#include "voxelcore/SpacingWeights.h"

#include <array>
#include <cmath>

namespace voxelcore
{

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
  std::array<TNumber, 3>      squared{};   ///< squared weights
  std::array<double, 3>       middle{};    ///< the circle's centre
  std::array<double, 3>       along{};     ///< index step per unit of length along the normal
  double                      circle2 = 0; ///< squared radius of the circle
  double                      scale = 0; ///< distance of the sphere's centre from the circle's = scale * value / height

  Pencil(const LatticePoint & pa, const LatticePoint & pb, const LatticePoint & pc, const SpacingWeights & weights)
    : a(pa)
  {
    const std::array<std::int64_t, 3> u{ pb.x - pa.x, pb.y - pa.y, pb.z - pa.z };
    const std::array<std::int64_t, 3> v{ pc.x - pa.x, pc.y - pa.y, pc.z - pa.z };
    normal = { u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0] };
    TNumber uu = 0;
    TNumber uv = 0;
    TNumber vv = 0;
    for (std::size_t i = 0; i < 3; ++i)
    {
      squared[i] = static_cast<TNumber>(weights.weight[i] * weights.weight[i]);
      uu += squared[i] * (u[i] * u[i]);
      uv += squared[i] * (u[i] * v[i]);
      vv += squared[i] * (v[i] * v[i]);
    }
    D = uu * vv - uv * uv;
    const TNumber alpha = vv * (uu - uv);
    const TNumber beta = uu * (vv - uv);
    const auto    d = static_cast<double>(D);
    const double  root = std::sqrt(d);
    const auto    product = static_cast<double>(weights.weight[0] * weights.weight[1] * weights.weight[2]);
    for (std::size_t i = 0; i < 3; ++i)
    {
      linear[i] = squared[i] * (alpha * u[i] + beta * v[i]);
      const double m = static_cast<double>(alpha * u[i] + beta * v[i]) / (2.0 * d);
      middle[i] = m;
      circle2 += static_cast<double>(squared[i]) * m * m;
      const auto w = static_cast<double>(weights.weight[i]);
      along[i] = product / w * static_cast<double>(normal[i]) / (root * w);
    }
    middle[0] += a.x;
    middle[1] += a.y;
    middle[2] += a.z;
    scale = 1.0 / (2.0 * product * root);
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
    return D * (squared[0] * (x * x) + squared[1] * (y * y) + squared[2] * (z * z)) -
           (linear[0] * x + linear[1] * y + linear[2] * z);
  }
};

} // namespace voxelcore
