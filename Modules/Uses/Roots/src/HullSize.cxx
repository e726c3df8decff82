#include "HullSize.h"

#include "voxelcore/Lattice/ConvexHull.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace voxelcore
{

HullSize
ConvexHullSize(const std::vector<Vector3> & points)
{
  if (points.empty())
  {
    return {};
  }
  // As whole numbers up to 2^29 every sign is exact.
  Vector3 least = points.front();
  Vector3 most = points.front();
  for (const Vector3 & point : points)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      least[axis] = std::min(least[axis], point[axis]);
      most[axis] = std::max(most[axis], point[axis]);
    }
  }
  const double side = std::max({ most[0] - least[0], most[1] - least[1], most[2] - least[2], 1e-300 });
  std::vector<std::array<std::int64_t, 3>> whole(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      whole[i][axis] = std::llround((points[i][axis] - least[axis]) / side * 0x1p29);
    }
  }
  HullSize hull;
  for (const HullFacet & facet : ConvexHull(whole))
  {
    const Vector3 & a = points[facet.corners[0]];
    const Vector3   normal = Cross(Minus(points[facet.corners[1]], a), Minus(points[facet.corners[2]], a));
    hull.surface += Length(normal) / 2;
    hull.volume += Dot(normal, Minus(a, points[0])) / 6;
  }
  return hull;
}

double
WidthAcross(const Vector3 & direction, const std::vector<Vector3> & places)
{
  constexpr double halfTurn = 3.14159265358979323846;
  Vector3          across = std::abs(direction[0]) < 0.9 ? Vector3{ 1, 0, 0 } : Vector3{ 0, 1, 0 };
  across = AddScaled(across, -Dot(across, direction), direction);
  across = AddScaled({ 0, 0, 0 }, 1 / Length(across), across);
  const Vector3 other = Cross(direction, across);
  double        width = 0;
  for (int side = 0; side < 180 && !places.empty(); ++side)
  {
    const double  turn = side * halfTurn / 180;
    const Vector3 towards = AddScaled(AddScaled({ 0, 0, 0 }, std::cos(turn), across), std::sin(turn), other);
    double        least = std::numeric_limits<double>::infinity();
    double        most = -least;
    for (const Vector3 & place : places)
    {
      const double at = Dot(place, towards);
      least = std::min(least, at);
      most = std::max(most, at);
    }
    width = std::max(width, most - least);
  }
  return width;
}

} // namespace voxelcore
