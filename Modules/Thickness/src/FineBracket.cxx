#include "voxelcore/FineBracket.h"

#include "voxelcore/BoundaryCounts.h"
#include "voxelcore/BoundaryVertices.h"
#include "voxelcore/StagePlan.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace voxelcore
{

namespace
{

constexpr double        kCutBoundingStep = 1.0 / 4; ///< of a box's shortest side: there are more balls than need be
constexpr std::uint64_t kMostToCutAll = 250'000;    ///< boundary vertices; cut, they are nine times as many

/** The balls of the cut lattice in the coordinates of the whole voxels. */
void
MoveToVoxels(PaintingBalls & balls, const std::array<std::int32_t, 3> & parts)
{
  for (Vector3 & centre : balls.centres)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      centre[axis] /= parts[axis];
    }
  }
}

} // namespace

std::array<std::int32_t, 3>
FineParts(const SpacingWeights & weights, double longest)
{
  double volume = 1;
  for (const std::int64_t weight : weights.weight)
  {
    volume *= static_cast<double>(weight);
  }
  std::array<std::int32_t, 3> parts{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    parts[axis] = 1;
    while (static_cast<double>(weights.weight[axis]) > longest * std::cbrt(volume) * parts[axis] * (1 + 1e-9))
    {
      parts[axis] += 2;
    }
  }
  return parts;
}

std::array<std::int32_t, 3>
PartsForBounds(const VoxelShape & shape, const SpacingWeights & weights)
{
  return FineParts(weights, CountBoundary(shape).vertices <= kMostToCutAll ? 0.99 : 1.01);
}

VoxelShape
CutVoxels(const VoxelShape & shape, const std::array<std::int32_t, 3> & parts)
{
  VoxelBox box = shape.Box();
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    box.lower[axis] *= parts[axis];
    box.size[axis] *= parts[axis];
  }
  VoxelShape cut(box);
  for (std::int32_t z = 0; z < box.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < box.size[1]; ++y)
    {
      const auto from = shape.Row(y / parts[1], z / parts[2]);
      const auto to = cut.Row(y, z);
      if (y % parts[1] != 0 || z % parts[2] != 0)
      {
        const auto same = cut.Row(y - y % parts[1], z - z % parts[2]);
        std::copy(same.begin(), same.end(), to.begin());
        continue;
      }
      for (std::size_t word = 0; word < from.size(); ++word)
      {
        for (std::uint64_t rest = from[word]; rest != 0; rest &= rest - 1)
        {
          const auto x =
            (64 * word + static_cast<std::size_t>(std::countr_zero(rest))) * static_cast<std::size_t>(parts[0]);
          for (std::size_t part = x; part < x + static_cast<std::size_t>(parts[0]); ++part)
          {
            to[part >> 6U] |= std::uint64_t{ 1 } << (part & 63U);
          }
        }
      }
    }
    if (z % 8 == 7)
    {
      cut.Compact(z - 7, z + 1);
    }
  }
  cut.Compact();
  return cut;
}

SpacingWeights
CutWeights(const SpacingWeights & weights, const std::array<std::int32_t, 3> & parts)
{
  const std::int64_t all = std::lcm(std::lcm(parts[0], parts[1]), parts[2]);
  SpacingWeights     cut = weights;
  std::int64_t       common = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    cut.weight[axis] = weights.weight[axis] * (all / parts[axis]);
    common = std::gcd(common, cut.weight[axis]);
  }
  for (std::int64_t & weight : cut.weight)
  {
    weight /= common;
  }
  cut.unit = weights.unit * static_cast<double>(common) / static_cast<double>(all);
  return cut;
}

void
TightenBracket(const VoxelShape &                  shape,
               const SpacingWeights &              weights,
               const std::array<std::int32_t, 3> & parts,
               ThicknessBracket &                  bracket,
               const ProgressCallback &            progress)
{
  StagePlan      plan(progress, { 0.3, 0.3, 0.2, 0.2 });
  ThicknessBalls balls;
  {
    const VoxelShape                cut = CutVoxels(shape, parts);
    const SpacingWeights            fine = CutWeights(weights, parts);
    const std::vector<LatticePoint> points = BoundaryVertices(cut);
    const DelaunayCells cells = ComputeDelaunayCells(cut, points, fine, Engine::Auto, plan.Next("thickness"));
    balls = FindThicknessBalls(cut, points, cells, fine, kCutBoundingStep, plan.Next("thickness"));
  }
  MoveToVoxels(balls.inscribed, parts);
  MoveToVoxels(balls.bounding, parts);
  const auto paint = [&](const PaintingBalls & some) {
    VoxelValues map = ZeroAtVoxels<float>(shape);
    PaintThickness(shape, weights, some, map, plan.Next("thickness"));
    return map;
  };
  const VoxelValues lower = paint(balls.inscribed);
  const VoxelValues upper = paint(balls.bounding);
  for (std::size_t i = 0; i < lower.values.size(); ++i)
  {
    bracket.lower.values[i] = std::max(bracket.lower.values[i], lower.values[i]);
    bracket.upper.values[i] = std::min(bracket.upper.values[i], upper.values[i]);
  }
}

} // namespace voxelcore
