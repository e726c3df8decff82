#include "ExactCentre.h"

#include <cmath>

namespace voxelcore::verification
{
namespace
{

using Offset = std::array<std::int64_t, 3>;

Offset
Difference(const LatticePoint & a, const LatticePoint & b)
{
  return { std::int64_t{ a.x } - b.x, std::int64_t{ a.y } - b.y, std::int64_t{ a.z } - b.z };
}

/** Entries up to N, those of one column up to 3 w^2 N^2. */
Int128
Determinant(const std::array<std::array<Int128, 3>, 3> & m)
{
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

Int128
WeightedSquare(const Offset & d, const SpacingWeights & weights)
{
  Int128 sum = 0;
  for (std::size_t a = 0; a < 3; ++a)
  {
    const Int128 scaled = Int128{ weights.weight[a] } * d[a];
    sum += scaled * scaled;
  }
  return sum;
}

/** Floor of n / d and the remainder, d > 0. */
Int128
FloorDivide(Int128 n, Int128 d, Int128 & remainder)
{
  Int128 quotient = n / d;
  remainder = n % d;
  if (remainder < 0)
  {
    remainder += d;
    --quotient;
  }
  return quotient;
}

/** Compares n1/d1 with n2/d2, denominators > 0, by their continued fractions: no product can overflow. */
int
CompareFractions(Int128 n1, Int128 d1, Int128 n2, Int128 d2)
{
  int sign = 1;
  while (true)
  {
    Int128       r1 = 0;
    Int128       r2 = 0;
    const Int128 q1 = FloorDivide(n1, d1, r1);
    const Int128 q2 = FloorDivide(n2, d2, r2);
    if (q1 != q2)
    {
      return q1 < q2 ? -sign : sign;
    }
    if (r1 == 0 || r2 == 0)
    {
      return r1 == r2 ? 0 : (r1 == 0 ? -sign : sign);
    }
    // r1/d1 < r2/d2 if and only if d1/r1 > d2/r2.
    n1 = d1;
    d1 = r1;
    n2 = d2;
    d2 = r2;
    sign = -sign;
  }
}

std::int32_t
Axis(const LatticePoint & point, std::size_t axis)
{
  return axis == 0 ? point.x : axis == 1 ? point.y : point.z;
}

Int128
TwiceSquaredWeight(const SpacingWeights & weights, std::size_t axis)
{
  return 2 * Int128{ weights.weight[axis] } * weights.weight[axis];
}

} // namespace

std::optional<ExactCentre>
SphereThrough(const std::array<LatticePoint, 4> & points, const SpacingWeights & weights)
{
  // Equal distances to points 0 and i: sum of 2 w^2 c_a d_a = sum of w^2 d_a^2. Cramer's rule for 2 w_a^2 c_a.
  std::array<std::array<Int128, 3>, 3> rows{};
  std::array<Int128, 3>                squares{};
  for (std::size_t i = 0; i < 3; ++i)
  {
    const Offset d = Difference(points[i + 1], points[0]);
    rows[i] = { d[0], d[1], d[2] };
    squares[i] = WeightedSquare(d, weights);
  }
  ExactCentre sphere{ points[0], {}, Determinant(rows) };
  if (sphere.denominator == 0)
  {
    return std::nullopt;
  }
  const Int128 sign = sphere.denominator < 0 ? -1 : 1;
  sphere.denominator *= sign;
  for (std::size_t a = 0; a < 3; ++a)
  {
    auto replaced = rows;
    for (std::size_t i = 0; i < 3; ++i)
    {
      replaced[i][a] = squares[i];
    }
    sphere.numerator[a] = sign * Determinant(replaced);
  }
  return sphere;
}

Int128
PowerSign(const ExactCentre & sphere, const LatticePoint & point, const SpacingWeights & weights)
{
  const Offset d = Difference(point, sphere.origin);
  return WeightedSquare(d, weights) * sphere.denominator - d[0] * sphere.numerator[0] - d[1] * sphere.numerator[1] -
         d[2] * sphere.numerator[2];
}

std::array<double, 3>
Coordinates(const ExactCentre & sphere, const SpacingWeights & weights)
{
  std::array<double, 3> coordinates{};
  for (std::size_t a = 0; a < 3; ++a)
  {
    coordinates[a] =
      Axis(sphere.origin, a) + static_cast<double>(sphere.numerator[a]) /
                                 static_cast<double>(TwiceSquaredWeight(weights, a) * sphere.denominator);
  }
  return coordinates;
}

double
Radius(const ExactCentre & sphere, const SpacingWeights & weights)
{
  double squared = 0;
  for (std::size_t a = 0; a < 3; ++a)
  {
    const double offset = static_cast<double>(sphere.numerator[a]) / static_cast<double>(sphere.denominator) /
                          (2.0 * static_cast<double>(weights.weight[a])); // weighted: w_a c_a
    squared += offset * offset;
  }
  return std::sqrt(squared);
}

int
CompareCentres(const ExactCentre & a, const ExactCentre & b, const SpacingWeights & weights)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const Int128 scale = TwiceSquaredWeight(weights, axis);
    const Int128 da = scale * a.denominator;
    const Int128 db = scale * b.denominator;
    const int    order = CompareFractions(Axis(a.origin, axis) * da + a.numerator[axis],
                                       da,
                                       Axis(b.origin, axis) * db + b.numerator[axis],
                                       db);
    if (order != 0)
    {
      return order;
    }
  }
  return 0;
}

} // namespace voxelcore::verification
