#include "Kinds.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{
namespace
{

double
Square(double x)
{
  return x * x;
}

/** A body given by a function of the place in mm from the middle. */
template <typename Inside>
VoxelShape
FillBody(const PhantomOptions & options, const ProgressCallback & progress, Inside && inside)
{
  const std::vector<double> xs = Centres(options, 0);
  const std::vector<double> ys = Centres(options, 1);
  const std::vector<double> zs = Centres(options, 2);
  return FillRowsInParallel(options, progress, [&](std::size_t yIndex, std::size_t zIndex) {
    return [&, y = ys[yIndex], z = zs[zIndex]](std::size_t xIndex) -> bool { return inside(xs[xIndex], y, z); };
  });
}

/** Sine and cosine of a number of turns by fixed polynomials (Taylor, to pi/4), since those of the C library may differ
 *  in the last bit from machine to machine. Good to about 1e-15; exactly odd and even. */
struct SineCosine
{
  double sine;
  double cosine;
};

SineCosine
OfTurns(double turns)
{
  const double fraction = std::abs(turns) - std::floor(std::abs(turns));
  const int    eighth = static_cast<int>(fraction * 8);
  const int    quarter = (eighth + 1) / 2; // the nearest multiple of a quarter turn
  const double x = (fraction - 0.25 * quarter) * 6.283185307179586;
  const double q = x * x;
  double       sine = -1.0 / 1307674368000;
  for (const double coefficient :
       { 1.0 / 6227020800, -1.0 / 39916800, 1.0 / 362880, -1.0 / 5040, 1.0 / 120, -1.0 / 6, 1.0 })
  {
    sine = sine * q + coefficient;
  }
  sine *= x;
  double cosine = 1.0 / 20922789888000;
  for (const double coefficient :
       { -1.0 / 87178291200, 1.0 / 479001600, -1.0 / 3628800, 1.0 / 40320, -1.0 / 720, 1.0 / 24, -1.0 / 2, 1.0 })
  {
    cosine = cosine * q + coefficient;
  }
  SineCosine result{ sine, cosine };
  for (int i = 0; i < quarter; ++i)
  {
    result = { result.cosine, -result.sine };
  }
  return { turns < 0 ? -result.sine : result.sine, result.cosine };
}

VoxelShape
MakeGyroid(const PhantomOptions & options, const ProgressCallback & progress)
{
  const double                           period = options.period.value_or(0.35 * ShortestSide(options));
  const double                           half = options.thickness.value_or(period / 8) / 2;
  std::array<std::vector<SineCosine>, 3> waves;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (const double centre : Centres(options, axis))
    {
      waves[axis].push_back(OfTurns(centre / period));
    }
  }
  // The distance to the surface g = 0 is |g| / |grad g| to first order: a sheet of even thickness.
  const double scale = Square(half * 6.283185307179586 / period);
  return FillRowsInParallel(options, progress, [&](std::size_t yIndex, std::size_t zIndex) {
    return [&, y = waves[1][yIndex], z = waves[2][zIndex]](std::size_t xIndex) -> bool {
      const SineCosine x = waves[0][xIndex];
      const double     g = x.sine * y.cosine + y.sine * z.cosine + z.sine * x.cosine;
      const double     gradient = Square(x.cosine * y.cosine - z.sine * x.sine) +
                              Square(y.cosine * z.cosine - x.sine * y.sine) +
                              Square(z.cosine * x.cosine - y.sine * z.sine);
      return g * g <= scale * gradient;
    };
  });
}

/** A capsule along u, rods along v and w that begin at its ends, a plate across w that begins at its axis. */
VoxelShape
MakeThickAndThin(const PhantomOptions & options, const ProgressCallback & progress)
{
  const double side = ShortestSide(options);
  const double half = 0.2 * side;
  const double reach = 0.42 * side;
  const double thick = Square(0.16 * side);
  const double thin = Square(options.radius.value_or(0.03 * side));
  const double plate = options.thickness.value_or(0.05 * side) / 2;
  // Distance squared to a rod's axis from (u0, 0) on.
  const auto rod = [=](double u, double along, double across, double u0) {
    return Square(u - u0) + Square(across) + Square(std::max({ 0.0, -along, along - reach }));
  };
  return FillBody(options, progress, [=](double x, double y, double z) {
    // A rotation in whole numbers, askew to all axes, so that staircases of all kinds show.
    const double u = (8 * x + y - 4 * z) / 9;
    const double v = (4 * y - 4 * x - 7 * z) / 9;
    const double w = (x + 8 * y + 4 * z) / 9;
    return Square(std::max(0.0, std::abs(u) - half)) + v * v + w * w <= thick || rod(u, v, w, -half) <= thin ||
           rod(u, w, v, half) <= thin || (std::abs(u) <= half && v <= 0 && v >= -reach && std::abs(w) <= plate);
  });
}

} // namespace

std::optional<VoxelShape>
MakeSolid(const PhantomOptions & options, const ProgressCallback & progress)
{
  const std::string & kind = options.kind;
  const Vector3       sides = Sides(options);
  const double        shortest = ShortestSide(options);
  if (kind == "ellipsoid")
  {
    const Vector3 axes{ 0.45 * sides[0], 0.30 * sides[1], 0.20 * sides[2] };
    return FillBody(options, progress, [=](double x, double y, double z) {
      return Square(x / axes[0]) + Square(y / axes[1]) + Square(z / axes[2]) <= 1;
    });
  }
  if (kind == "ball")
  {
    const double squared = Square(options.radius.value_or(0.45 * shortest));
    return FillBody(options, progress, [=](double x, double y, double z) { return x * x + y * y + z * z <= squared; });
  }
  if (kind == "shell")
  {
    const double radius = options.radius.value_or(0.45 * shortest);
    const double inner = std::max(0.0, radius - options.thickness.value_or(radius / 3));
    return FillBody(options,
                    progress,
                    [outer2 = radius * radius, inner2 = inner * inner](double x, double y, double z) {
                      const double squared = x * x + y * y + z * z;
                      return squared <= outer2 && squared > inner2;
                    });
  }
  if (kind == "capsule")
  {
    const double radius = options.radius.value_or(0.15 * shortest);
    const double half = std::max(0.0, 0.45 * sides[0] - radius);
    return FillBody(options, progress, [=](double x, double y, double z) {
      return Square(std::max(0.0, std::abs(x) - half)) + y * y + z * z <= radius * radius;
    });
  }
  if (kind == "box")
  {
    return FillBody(options, progress, [=](double x, double y, double z) {
      return std::abs(x) <= 0.4 * sides[0] && std::abs(y) <= 0.4 * sides[1] && std::abs(z) <= 0.4 * sides[2];
    });
  }
  if (kind == "plate")
  {
    const double half = options.thickness.value_or(0.1 * sides[2]) / 2;
    return FillBody(options, progress, [=](double x, double y, double z) {
      return std::abs(x) <= 0.45 * sides[0] && std::abs(y) <= 0.45 * sides[1] && std::abs(z) <= half;
    });
  }
  if (kind == "rod")
  {
    const double squared = Square(options.radius.value_or(0.1 * shortest));
    return FillBody(options, progress, [=](double x, double y, double z) {
      return x * x + y * y <= squared && std::abs(z) <= 0.45 * sides[2];
    });
  }
  if (kind == "torus")
  {
    const double ring = 0.3 * shortest;
    const double squared = Square(options.radius.value_or(0.12 * shortest));
    return FillBody(options, progress, [=](double x, double y, double z) {
      return Square(std::sqrt(x * x + y * y) - ring) + z * z <= squared;
    });
  }
  if (kind == "tanglecube")
  {
    // x^4 - 5 x^2 + y^4 - 5 y^2 + z^4 - 5 z^2 + 11.8 <= 0 reaches to 2.27; the grid's side is 5.
    const Vector3 scale{ 5 / sides[0], 5 / sides[1], 5 / sides[2] };
    return FillBody(options, progress, [=](double x, double y, double z) {
      const auto term = [](double u) { return (u * u - 5) * (u * u); };
      return term(x * scale[0]) + term(y * scale[1]) + term(z * scale[2]) + 11.8 <= 0;
    });
  }
  if (kind == "thick-and-thin")
  {
    return MakeThickAndThin(options, progress);
  }
  if (kind == "gyroid")
  {
    return MakeGyroid(options, progress);
  }
  return std::nullopt;
}

} // namespace voxelcore
