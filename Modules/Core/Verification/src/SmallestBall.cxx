#include "SmallestBall.h"

#include "Vectors.h"

#include <cstddef>

namespace voxelcore::verification
{
namespace
{

using Points = std::span<const Position>;

struct Ball
{
  Position centre{ 0, 0, 0 };
  double   squaredRadius = 0;
};

/** Cospherical points outside a support's ball are further out than this by far, those on it never. */
bool
IsOutside(const Ball & ball, const Position & point)
{
  const Position d = Minus(point, ball.centre);
  return Dot(d, d) > ball.squaredRadius * (1 + 1e-11);
}

Ball
BallAt(const Position & origin, const Position & offset)
{
  return { { origin[0] + offset[0], origin[1] + offset[1], origin[2] + offset[2] }, Dot(offset, offset) };
}

Ball
BallOfTwo(const Position & p, const Position & q)
{
  const Position a = Minus(q, p);
  return BallAt(p, { a[0] / 2, a[1] / 2, a[2] / 2 });
}

Ball
BallOfThree(const Position & p, const Position & q, const Position & r)
{
  const Position a = Minus(q, p);
  const Position b = Minus(r, p);
  const Position normal = Cross(a, b);
  const double   aa = Dot(a, a);
  const double   bb = Dot(b, b);
  const Position mixed{ aa * b[0] - bb * a[0], aa * b[1] - bb * a[1], aa * b[2] - bb * a[2] };
  const Position numerator = Cross(mixed, normal);
  const double   denominator = 2 * Dot(normal, normal);
  return BallAt(p, { numerator[0] / denominator, numerator[1] / denominator, numerator[2] / denominator });
}

Ball
BallOfFour(const Position & p, const Position & q, const Position & r, const Position & s)
{
  const Position a = Minus(q, p);
  const Position b = Minus(r, p);
  const Position c = Minus(s, p);
  const Position bc = Cross(b, c);
  const Position ca = Cross(c, a);
  const Position ab = Cross(a, b);
  const double   denominator = 2 * Dot(a, bc);
  const double   aa = Dot(a, a);
  const double   bb = Dot(b, b);
  const double   cc = Dot(c, c);
  Position       offset{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    offset[axis] = (aa * bc[axis] + bb * ca[axis] + cc * ab[axis]) / denominator;
  }
  return BallAt(p, offset);
}

Ball
WithThreeOnBoundary(Points points, const Position & p, const Position & q, const Position & r)
{
  Ball ball = BallOfThree(p, q, r);
  for (const Position & s : points)
  {
    if (IsOutside(ball, s))
    {
      ball = BallOfFour(p, q, r, s);
    }
  }
  return ball;
}

Ball
WithTwoOnBoundary(Points points, const Position & p, const Position & q)
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
WithOneOnBoundary(Points points, const Position & p)
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
