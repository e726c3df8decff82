#include "voxelcore/Lattice/Predicates.h"

#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <cmath>

namespace voxelcore
{

namespace
{

using Big = boost::multiprecision::cpp_int;

struct Difference
{
  std::int64_t x, y, z;
};

Difference
operator-(const LatticePoint & a, const LatticePoint & b)
{
  return { std::int64_t{ a.x } - b.x, std::int64_t{ a.y } - b.y, std::int64_t{ a.z } - b.z };
}

// At least the greatest absolute value, at most twice that plus one.
std::uint64_t
Magnitude(const Difference & d)
{
  return static_cast<std::uint64_t>(std::abs(d.x)) | static_cast<std::uint64_t>(std::abs(d.y)) |
         static_cast<std::uint64_t>(std::abs(d.z));
}

Int128
Dot(const Difference & a, const Difference & b, const SpacingWeights & weights)
{
  const auto & w = weights.weight;
  // Three terms below 2^36 * 2^24 each fit 64 bits.
  const std::uint64_t reach = Magnitude(a) | Magnitude(b);
  if (reach < (std::uint64_t{ 1 } << 18) && (w[0] | w[1] | w[2]) <= 4096)
  {
    return a.x * b.x * (w[0] * w[0]) + a.y * b.y * (w[1] * w[1]) + a.z * b.z * (w[2] * w[2]);
  }
  return Int128{ a.x * b.x } * (w[0] * w[0]) + Int128{ a.y * b.y } * (w[1] * w[1]) +
         Int128{ a.z * b.z } * (w[2] * w[2]);
}

int
Bits(Int128 value)
{
  return BitLength(static_cast<UInt128>(value < 0 ? -value : value));
}

int
Sign(const Int128 value)
{
  return (value > 0) - (value < 0);
}

Big
ToBig(Int128 value)
{
  const bool negative = value < 0;
  const auto magnitude = static_cast<UInt128>(negative ? -value : value);
  Big        big = static_cast<std::uint64_t>(magnitude >> 64);
  big <<= 64;
  big += static_cast<std::uint64_t>(magnitude);
  return negative ? Big(-big) : big;
}

UInt128
FromBig(const Big & value)
{
  return static_cast<UInt128>(value);
}

// The rare long fractions: 64 bits of quotient and a sticky bit below them round as the exact quotient does.
double
BigRatioToDouble(const Big & numerator, const Big & denominator)
{
  if (numerator == 0)
  {
    return 0.0;
  }
  const int shift = 64 - static_cast<int>(boost::multiprecision::msb(numerator)) +
                    static_cast<int>(boost::multiprecision::msb(denominator));
  Big quotient;
  Big remainder;
  if (shift >= 0)
  {
    boost::multiprecision::divide_qr(Big(numerator << shift), denominator, quotient, remainder);
  }
  else
  {
    boost::multiprecision::divide_qr(numerator, Big(denominator << -shift), quotient, remainder);
  }
  const UInt128 sticky = (FromBig(quotient) << 1) | (remainder == 0 ? 0U : 1U);
  return std::ldexp(RatioToDouble(sticky, 1), -shift - 1);
}

struct Fraction
{
  Int128  numerator;
  UInt128 denominator;
};

// The centre's coordinate base + n / (2 det w^2) as one fraction; 18 w^2 N^4 and 12 w^2 N^4 leave room in 127 bits
// wherever the in-sphere value 72 w^2 N^5 does, as long as the coordinate itself is at most 2^20.
Fraction
CentreFraction(const CircumSphere & sphere, std::size_t axis, const SpacingWeights & weights)
{
  const std::int64_t base = axis == 0 ? sphere.base.x : axis == 1 ? sphere.base.y : sphere.base.z;
  const Int128       q = 2 * sphere.det * (weights.weight[axis] * weights.weight[axis]);
  return { q * base + sphere.n[axis], static_cast<UInt128>(q) };
}

} // namespace

double
InSphereBits(std::int64_t extent, const SpacingWeights & weights)
{
  const auto greatest = *std::max_element(weights.weight.begin(), weights.weight.end());
  return std::log2(72.0) + 2.0 * std::log2(static_cast<double>(greatest)) +
         5.0 * std::log2(static_cast<double>(extent));
}

bool
ExactRangeAllows(std::int64_t extent, const SpacingWeights & weights)
{
  return extent <= 1 || InSphereBits(extent, weights) < 126.99;
}

Int128
SquaredDistance(const LatticePoint & a, const LatticePoint & b, const SpacingWeights & weights)
{
  const Difference d = a - b;
  return Dot(d, d, weights);
}

Int128
Orientation(const LatticePoint & a, const LatticePoint & b, const LatticePoint & c, const LatticePoint & d)
{
  const Difference u = b - a;
  const Difference v = c - a;
  const Difference w = d - a;
  if ((Magnitude(u) | Magnitude(v) | Magnitude(w)) < (std::uint64_t{ 1 } << 20)) // 6 N^3 < 2^63
  {
    return u.x * (v.y * w.z - v.z * w.y) + u.y * (v.z * w.x - v.x * w.z) + u.z * (v.x * w.y - v.y * w.x);
  }
  return Int128{ u.x } * (v.y * w.z - v.z * w.y) + Int128{ u.y } * (v.z * w.x - v.x * w.z) +
         Int128{ u.z } * (v.x * w.y - v.y * w.x);
}

CircumSphere
MakeCircumSphere(const LatticePoint &   a,
                 const LatticePoint &   b,
                 const LatticePoint &   c,
                 const LatticePoint &   d,
                 const SpacingWeights & weights)
{
  // Cramer's rule for 2 M y = s with the differences as rows of M and y = w^2 (centre - a).
  const Difference u = b - a;
  const Difference v = c - a;
  const Difference w = d - a;
  const Int128     su = Dot(u, u, weights);
  const Int128     sv = Dot(v, v, weights);
  const Int128     sw = Dot(w, w, weights);

  const auto minor = [](std::int64_t p, std::int64_t q, std::int64_t r, std::int64_t s) { return p * s - q * r; };
  const std::array<std::int64_t, 3> vw{ minor(v.y, v.z, w.y, w.z),
                                        minor(v.z, v.x, w.z, w.x),
                                        minor(v.x, v.y, w.x, w.y) };
  const std::array<std::int64_t, 3> wu{ minor(w.y, w.z, u.y, u.z),
                                        minor(w.z, w.x, u.z, u.x),
                                        minor(w.x, w.y, u.x, u.y) };
  const std::array<std::int64_t, 3> uv{ minor(u.y, u.z, v.y, v.z),
                                        minor(u.z, u.x, v.z, v.x),
                                        minor(u.x, u.y, v.x, v.y) };

  CircumSphere sphere;
  sphere.base = a;
  sphere.det = Orientation(a, b, c, d);
  if (std::max({ su, sv, sw }) < (Int128{ 1 } << 30)) // minors <= 2 * 2^30, so three products stay below 2^63
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      sphere.n[axis] = static_cast<std::int64_t>(su) * vw[axis] + static_cast<std::int64_t>(sv) * wu[axis] +
                       static_cast<std::int64_t>(sw) * uv[axis];
    }
  }
  else
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      sphere.n[axis] = su * vw[axis] + sv * wu[axis] + sw * uv[axis];
    }
  }
  if (sphere.det < 0)
  {
    sphere.det = -sphere.det;
    for (Int128 & n : sphere.n)
    {
      n = -n;
    }
  }
  return sphere;
}

Int128
Power(const CircumSphere & sphere, const LatticePoint & point, const SpacingWeights & weights)
{
  const Difference d = point - sphere.base;
  return sphere.det * Dot(d, d, weights) - (sphere.n[0] * d.x + sphere.n[1] * d.y + sphere.n[2] * d.z);
}

double
CentreCoordinate(const CircumSphere & sphere, std::size_t axis, const SpacingWeights & weights)
{
  const Fraction f = CentreFraction(sphere, axis, weights);
  return SignedRatioToDouble(f.numerator, f.denominator);
}

int
CompareCentreCoordinates(const CircumSphere &   a,
                         const CircumSphere &   b,
                         std::size_t            axis,
                         const SpacingWeights & weights)
{
  const Fraction p = CentreFraction(a, axis, weights);
  const Fraction q = CentreFraction(b, axis, weights);
  return CompareRatios(p.numerator,
                       static_cast<Int128>(p.denominator),
                       q.numerator,
                       static_cast<Int128>(q.denominator));
}

double
SquaredRadius(const CircumSphere & sphere, const SpacingWeights & weights)
{
  // R^2 = sum of n^2 / (4 det^2 w^2), with the common denominator 4 det^2 (w1 w2 w3)^2 unless the weights are equal.
  const auto &                w = weights.weight;
  const bool                  equal = w[0] == w[1] && w[1] == w[2];
  const std::array<Int128, 3> factor{ equal ? 1 : Int128{ w[1] } * w[2],
                                      equal ? 1 : Int128{ w[2] } * w[0],
                                      equal ? 1 : Int128{ w[0] } * w[1] };
  const Int128 common = equal ? Int128{ w[0] } : Int128{ w[0] } * w[1] * w[2];
  const int    denominatorBits = 2 + 2 * (Bits(sphere.det) + Bits(common));
  int          numeratorBits = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    numeratorBits = std::max(numeratorBits, 2 * (Bits(sphere.n[axis]) + Bits(factor[axis])) + 2);
  }
  if (denominatorBits <= 125 && numeratorBits <= 125)
  {
    Int128 numerator = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const Int128 root = sphere.n[axis] * factor[axis];
      numerator += root * root;
    }
    const Int128 root = 2 * sphere.det * common;
    return RatioToDouble(static_cast<UInt128>(numerator), static_cast<UInt128>(root * root));
  }
  Big numerator = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const Big root = ToBig(sphere.n[axis]) * ToBig(factor[axis]);
    numerator += root * root;
  }
  const Big root = 2 * ToBig(sphere.det) * ToBig(common);
  return BigRatioToDouble(numerator, root * root);
}

double
SquaredCircumradius(const LatticePoint &   a,
                    const LatticePoint &   b,
                    const LatticePoint &   c,
                    const SpacingWeights & weights)
{
  // r^2 = |ab|^2 |ac|^2 |bc|^2 / (4 |ab x ac|^2), and |u x v|^2 = |u|^2 |v|^2 - (u.v)^2.
  const Difference u = b - a;
  const Difference v = c - a;
  const Difference w = c - b;
  const Int128     uu = Dot(u, u, weights);
  const Int128     vv = Dot(v, v, weights);
  const Int128     ww = Dot(w, w, weights);
  const Int128     uv = Dot(u, v, weights);
  if (Bits(uu) + Bits(vv) + std::max(Bits(ww), 3) <= 125)
  {
    return RatioToDouble(static_cast<UInt128>(uu * vv * ww), static_cast<UInt128>(4 * (uu * vv - uv * uv)));
  }
  const Big bu = ToBig(uu);
  const Big bv = ToBig(vv);
  const Big dot = ToBig(uv);
  return BigRatioToDouble(bu * bv * ToBig(ww), 4 * (bu * bv - dot * dot));
}

int
CentreSide(const LatticePoint &   a,
           const LatticePoint &   b,
           const LatticePoint &   c,
           const LatticePoint &   apex,
           const SpacingWeights & weights)
{
  // With m = (alpha u + beta v) / (2 |u x v|^2) the circle's centre from a, alpha = vv (uu - uv), beta = uu (vv - uv):
  // |d|^2 - 2 d.m has the sign of |d|^2 |u x v|^2 - alpha (d.u) - beta (d.v).
  const Difference u = b - a;
  const Difference v = c - a;
  const Difference d = apex - a;
  // Terms of degree three in squared lengths, at most five of them in all.
  const auto value = [](auto U, auto V, auto W, auto dd, auto du, auto dv) {
    return dd * (U * V - W * W) - V * (U - W) * du - U * (V - W) * dv;
  };
  const auto & w = weights.weight;
  if ((Magnitude(u) | Magnitude(v) | Magnitude(d)) * static_cast<std::uint64_t>(w[0] | w[1] | w[2]) < 256)
  {
    // Squared lengths below 3 * 2^16, so that all fits 57 bits.
    const auto dot = [&](const Difference & p, const Difference & q) {
      return p.x * q.x * (w[0] * w[0]) + p.y * q.y * (w[1] * w[1]) + p.z * q.z * (w[2] * w[2]);
    };
    return Sign(value(dot(u, u), dot(v, v), dot(u, v), dot(d, d), dot(d, u), dot(d, v)));
  }
  const Int128 uu = Dot(u, u, weights);
  const Int128 vv = Dot(v, v, weights);
  const Int128 uv = Dot(u, v, weights);
  const Int128 dd = Dot(d, d, weights);
  const Int128 du = Dot(d, u, weights);
  const Int128 dv = Dot(d, v, weights);
  const int    longest = std::max({ Bits(uu), Bits(vv), Bits(dd) });
  const auto   valueAs = [&]<typename T>(T) {
    return value(static_cast<T>(uu),
                 static_cast<T>(vv),
                 static_cast<T>(uv),
                 static_cast<T>(dd),
                 static_cast<T>(du),
                 static_cast<T>(dv));
  };
  if (3 * longest + 3 <= 62)
  {
    return Sign(valueAs(std::int64_t{}));
  }
  if (3 * longest + 3 <= 126)
  {
    return Sign(valueAs(Int128{}));
  }
  const Big U = ToBig(uu);
  const Big V = ToBig(vv);
  const Big W = ToBig(uv);
  return Big(ToBig(dd) * (U * V - W * W) - V * (U - W) * ToBig(du) - U * (V - W) * ToBig(dv)).sign();
}

int
AngleSign(const LatticePoint & corner, const LatticePoint & a, const LatticePoint & b, const SpacingWeights & weights)
{
  return Sign(Dot(a - corner, b - corner, weights));
}

} // namespace voxelcore
