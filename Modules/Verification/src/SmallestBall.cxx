#include "SmallestBall.h"

#include <cmath>
#include <cstddef>

namespace voxelcore::verification
{
namespace
{

using Vector = std::array<double, 3>;
using Points = std::span<const Vector>;

struct Ball
{
  Vector centre{ 0, 0, 0 };
  double squaredRadius = 0;
};

Vector
Minus(const Vector & a, const Vector & b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

double
Dot(const Vector & a, const Vector & b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector
Cross(const Vector & a, const Vector & b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

/** Cospherical points outside a support's ball are further out than this by far, those on it never. */
bool
IsOutside(const Ball & ball, const Vector & point)
{
  const Vector d = Minus(point, ball.centre);
  return Dot(d, d) > ball.squaredRadius * (1 + 1e-11);
}

Ball
BallAt(const Vector & origin, const Vector & offset)
{
  return { { origin[0] + offset[0], origin[1] + offset[1], origin[2] + offset[2] }, Dot(offset, offset) };
}

Ball
BallOfTwo(const Vector & p, const Vector & q)
{
  const Vector a = Minus(q, p);
  return BallAt(p, { a[0] / 2, a[1] / 2, a[2] / 2 });
}

Ball
BallOfThree(const Vector & p, const Vector & q, const Vector & r)
{
  const Vector a = Minus(q, p);
  const Vector b = Minus(r, p);
  const Vector normal = Cross(a, b);
  const double aa = Dot(a, a);
  const double bb = Dot(b, b);
  const Vector mixed{ aa * b[0] - bb * a[0], aa * b[1] - bb * a[1], aa * b[2] - bb * a[2] };
  const Vector numerator = Cross(mixed, normal);
  const double denominator = 2 * Dot(normal, normal);
  return BallAt(p, { numerator[0] / denominator, numerator[1] / denominator, numerator[2] / denominator });
}

Ball
BallOfFour(const Vector & p, const Vector & q, const Vector & r, const Vector & s)
{
  const Vector a = Minus(q, p);
  const Vector b = Minus(r, p);
  const Vector c = Minus(s, p);
  const Vector bc = Cross(b, c);
  const Vector ca = Cross(c, a);
  const Vector ab = Cross(a, b);
  const double denominator = 2 * Dot(a, bc);
  const double aa = Dot(a, a);
  const double bb = Dot(b, b);
  const double cc = Dot(c, c);
  Vector       offset{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    offset[axis] = (aa * bc[axis] + bb * ca[axis] + cc * ab[axis]) / denominator;
  }
  return BallAt(p, offset);
}

Ball
WithThreeOnBoundary(Points points, const Vector & p, const Vector & q, const Vector & r)
{
  Ball ball = BallOfThree(p, q, r);
  for (const Vector & s : points)
  {
    if (IsOutside(ball, s))
    {
      ball = BallOfFour(p, q, r, s);
    }
  }
  return ball;
}

Ball
WithTwoOnBoundary(Points points, const Vector & p, const Vector & q)
{
  Ball ball = BallOfTwo(p, q);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (IsOutside(ball, points[i]))
    {
      ball = WithThreeOnBoundary(points.first(i), p, q, points[i]);
    }
  }
  return ball;
}

Ball
WithOneOnBoundary(Points points, const Vector & p)
{
  Ball ball{ p, 0 };
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (IsOutside(ball, points[i]))
    {
      ball = WithTwoOnBoundary(points.first(i), p, points[i]);
    }
  }
  return ball;
}

} // namespace

double
SmallestBallSquaredRadius(Points points)
{
  if (points.empty())
  {
    return 0;
  }
  Ball ball{ points[0], 0 };
  for (std::size_t i = 1; i < points.size(); ++i)
  {
    if (IsOutside(ball, points[i]))
    {
      ball = WithOneOnBoundary(points.first(i), points[i]);
    }
  }
  return ball.squaredRadius;
}

} // namespace voxelcore::verification
