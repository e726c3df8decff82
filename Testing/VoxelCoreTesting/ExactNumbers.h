#pragma once
// The reference for exact arithmetic: integers and fractions of any length.

#include "voxelcore/Lattice/LatticePoint.h"
#include "voxelcore/Lattice/Rational.h"
#include "voxelcore/Lattice/SpacingWeights.h"

#include <boost/multiprecision/cpp_int.hpp>

#include <cmath>
#include <optional>

namespace voxelcore::testing
{

using BigInteger = boost::multiprecision::cpp_int;
using BigRational = boost::multiprecision::cpp_rational;
using BigVector = std::array<BigRational, 3>;

inline BigInteger
ToBigInteger(Int128 value)
{
  const bool       negative = value < 0;
  const auto       magnitude = negative ? UInt128{ 0 } - static_cast<UInt128>(value) : static_cast<UInt128>(value);
  const BigInteger big =
    (BigInteger(static_cast<std::uint64_t>(magnitude >> 64)) << 64) + static_cast<std::uint64_t>(magnitude);
  return negative ? BigInteger(-big) : big;
}

/** A double as the fraction it is. */
inline BigRational
ToBigRational(double value)
{
  int        exponent = 0;
  const auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(value, &exponent), 53));
  exponent -= 53;
  return exponent >= 0 ? BigRational(BigInteger(mantissa) << exponent)
                       : BigRational(BigInteger(mantissa), BigInteger(1) << -exponent);
}

/** Whether no double lies nearer to `exact` than `value`, and a tie went to the even one. */
inline bool
IsNearestDouble(double value, const BigRational & exact)
{
  const auto        distance = [&](double d) { return BigRational(abs(BigRational(ToBigRational(d) - exact))); };
  const BigRational own = distance(value);
  for (const double other : { std::nextafter(value, HUGE_VAL), std::nextafter(value, -HUGE_VAL) })
  {
    int        exponent = 0;
    const auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(value, &exponent), 53));
    const auto away = distance(other);
    if (away < own || (away == own && mantissa % 2 != 0))
    {
      return false;
    }
  }
  return true;
}

inline BigVector
ToBigVector(const LatticePoint & p)
{
  return { BigRational(p.x), BigRational(p.y), BigRational(p.z) };
}

/** Squared weighted distance of two places given in lattice coordinates. */
inline BigRational
ExactSquaredDistance(const BigVector & a, const BigVector & b, const SpacingWeights & weights)
{
  BigRational sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const BigRational d = (a[axis] - b[axis]) * weights.weight[axis];
    sum += d * d;
  }
  return sum;
}

inline BigRational
ExactDeterminant(const BigVector & u, const BigVector & v, const BigVector & w)
{
  return u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) + u[2] * (v[0] * w[1] - v[1] * w[0]);
}

inline BigVector
operator-(const BigVector & a, const BigVector & b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

/** The point of the affine hull of 2 to 4 places that is equally far from all of them, in lattice coordinates; none if
 *  they are not affinely independent. Gauss elimination on the Gram matrix: another way than Cramer's rule. */
inline std::optional<BigVector>
ExactCircumcentre(const std::vector<LatticePoint> & points, const SpacingWeights & weights)
{
  // centre = p0 + sum of t_i d_i with d_i = p_i - p0 and 2 (d_i . d_j) t = d_i . d_i in the weighted product.
  const std::size_t      n = points.size() - 1;
  std::vector<BigVector> d(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    d[i] = ToBigVector(points[i + 1]) - ToBigVector(points[0]);
  }
  const auto dot = [&](const BigVector & a, const BigVector & b) {
    BigRational sum = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      sum += a[axis] * b[axis] * weights.weight[axis] * weights.weight[axis];
    }
    return sum;
  };
  std::vector<std::vector<BigRational>> m(n, std::vector<BigRational>(n + 1));
  for (std::size_t i = 0; i < n; ++i)
  {
    for (std::size_t j = 0; j < n; ++j)
    {
      m[i][j] = 2 * dot(d[i], d[j]);
    }
    m[i][n] = dot(d[i], d[i]);
  }
  for (std::size_t column = 0; column < n; ++column)
  {
    std::size_t pivot = column;
    while (pivot < n && m[pivot][column] == 0)
    {
      ++pivot;
    }
    if (pivot == n)
    {
      return {};
    }
    std::swap(m[pivot], m[column]);
    for (std::size_t row = 0; row < n; ++row)
    {
      if (row != column && m[row][column] != 0)
      {
        const BigRational factor = m[row][column] / m[column][column];
        for (std::size_t j = column; j <= n; ++j)
        {
          m[row][j] -= factor * m[column][j];
        }
      }
    }
  }
  BigVector centre = ToBigVector(points[0]);
  for (std::size_t i = 0; i < n; ++i)
  {
    const BigRational t = m[i][n] / m[i][i];
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      centre[axis] += t * d[i][axis];
    }
  }
  return centre;
}

} // namespace voxelcore::testing
