#include "SurfaceBends.h"

#include "voxelcore/Lattice/Vectors.h"

#include <cmath>

namespace voxelcore
{

std::array<Vector3, 2>
TangentsOf(const Vector3 & normal, const Vector3 & near)
{
  const Vector3 axis = std::abs(normal[0]) < 0.6 ? Vector3{ 1, 0, 0 } : Vector3{ 0, 1, 0 };
  const Vector3 along = Length(near) > 0 ? near : AddScaled(axis, -Dot(axis, normal), normal);
  const Vector3 u = AddScaled({ 0, 0, 0 }, 1 / Length(along), along);
  return { u, Cross(normal, u) };
}

SurfaceBend
BendOf(const SurfaceEstimate & surface, const SurfacePoint & at, double stride, double reach)
{
  const std::array<Vector3, 2> ways = TangentsOf(at.normal, { 0, 0, 0 });
  std::array<Vector3, 2>       turns{};
  for (std::size_t way = 0; way < 2; ++way)
  {
    const SurfacePoint before = surface.Project(AddScaled(at.position, -stride, ways[way]), reach);
    const SurfacePoint after = surface.Project(AddScaled(at.position, stride, ways[way]), reach);
    const double       apart = Dot(Minus(after.position, before.position), ways[way]);
    if (!before.found || !after.found || !(apart > stride))
    {
      return {};
    }
    turns[way] = AddScaled({ 0, 0, 0 }, 1 / apart, Minus(after.normal, before.normal));
  }
  SurfaceBend bend;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    bend.along[axis] = static_cast<float>(ways[0][axis]);
  }
  bend.bends = { static_cast<float>(Dot(ways[0], turns[0])),
                 static_cast<float>(0.5 * (Dot(ways[0], turns[1]) + Dot(ways[1], turns[0]))),
                 static_cast<float>(Dot(ways[1], turns[1])) };
  bend.stride = static_cast<float>(stride);
  return bend;
}

DistanceBends
DistanceBendsOf(const SurfaceBend & bend, const Vector3 & normal, double away)
{
  const Vector3 u{ bend.along[0], bend.along[1], bend.along[2] };
  const Vector3 v = Cross(normal, u);
  const double  a = 1 + away * bend.bends[0];
  const double  b = away * bend.bends[1];
  const double  c = 1 + away * bend.bends[2];
  const double  half = 0.5 * (a - c);
  const double  apart = std::sqrt(half * half + b * b);
  // The direction of the greater one.
  const double  cosine = half + apart;
  const double  length = std::sqrt(cosine * cosine + b * b);
  const bool    turned = half < 0 && length < 1e-9 * (1 + apart);
  const Vector3 more =
    length > 0 && !turned ? AddScaled(AddScaled({ 0, 0, 0 }, cosine / length, u), b / length, v) : (turned ? v : u);
  return { { 0.5 * (a + c) - apart, 0.5 * (a + c) + apart }, { Cross(normal, more), more } };
}

} // namespace voxelcore
