#include "voxelcore/Thickness/FineBracket.h"

#include "voxelcore/Base/StagePlan.h"
#include "voxelcore/Shape/BoundaryCounts.h"
#include "voxelcore/Shape/BoundaryVertices.h"

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

/** Whether a part of a voxel is to be in. */
enum class Reaching
{
  Any, ///< where it reaches between centres of which one is in
  All  ///< where it reaches between no centres but those that are in
};

/** Along an axis, the centres around a part: on its voxel's either side where it holds the voxel's own. */
std::array<std::int32_t, 2>
CentresAround(std::int32_t part, std::int32_t parts)
{
  return { 2 * part + 1 <= parts ? -1 : 0, 2 * part + 1 >= parts ? 1 : 0 };
}

bool
IsIn(const VoxelShape &                  shape,
     const std::array<std::int32_t, 3> & fine,
     const std::array<std::int32_t, 3> & parts,
     Reaching                            reaching)
{
  std::array<std::int32_t, 3>                voxel{};
  std::array<std::array<std::int32_t, 2>, 3> around{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    voxel[axis] = static_cast<std::int32_t>(std::floor(static_cast<double>(fine[axis]) / parts[axis]));
    around[axis] = CentresAround(fine[axis] - voxel[axis] * parts[axis], parts[axis]);
  }
  for (std::int32_t z = around[2][0]; z <= around[2][1]; ++z)
  {
    for (std::int32_t y = around[1][0]; y <= around[1][1]; ++y)
    {
      for (std::int32_t x = around[0][0]; x <= around[0][1]; ++x)
      {
        if (shape.Contains(voxel[0] + x, voxel[1] + y, voxel[2] + z) == (reaching == Reaching::Any))
        {
          return reaching == Reaching::Any;
        }
      }
    }
  }
  return reaching == Reaching::All;
}

/** The parts of voxels that are in, a voxel more around the shape. */
VoxelShape
PartsReaching(const VoxelShape & shape, const std::array<std::int32_t, 3> & parts, Reaching reaching)
{
  VoxelBox box = shape.Box();
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    box.lower[axis] = (box.lower[axis] - 1) * parts[axis];
    box.size[axis] = (box.size[axis] + 2) * parts[axis];
  }
  VoxelShape fine(box);
  for (std::int32_t z = box.lower[2]; z < box.lower[2] + box.size[2]; ++z)
  {
    for (std::int32_t y = box.lower[1]; y < box.lower[1] + box.size[1]; ++y)
    {
      for (std::int32_t x = box.lower[0]; x < box.lower[0] + box.size[0]; ++x)
      {
        if (IsIn(shape, { x, y, z }, parts, reaching))
        {
          fine.Insert(x, y, z);
        }
      }
    }
  }
  return CropToVoxels(std::move(fine));
}

ThicknessBalls
BallsOfCut(const VoxelShape & cut, const SpacingWeights & fine, double boundingStep, const ProgressCallback & progress)
{
  StagePlan                       plan(progress, { 0.5, 0.5 });
  const std::vector<LatticePoint> points = BoundaryVertices(cut);
  const DelaunayCells             cells = ComputeDelaunayCells(cut, points, fine, Engine::Auto, plan.Next("thickness"));
  return FindThicknessBalls(cut, points, cells, fine, boundingStep, plan.Next("thickness"));
}

/** The greatest value of the balls, of a lattice of such parts, that hold a voxel's centre. */
VoxelValues
PaintedBy(PaintingBalls                       balls,
          const VoxelShape &                  shape,
          const SpacingWeights &              weights,
          const std::array<std::int32_t, 3> & parts,
          const ProgressCallback &            progress)
{
  MoveToVoxels(balls, parts);
  VoxelValues map = ZeroAtVoxels<float>(shape);
  PaintThickness(shape, weights, balls, map, progress);
  return map;
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
  return CountBoundary(shape).vertices <= kMostToCutAll ? PartsForBounds(weights) : FineParts(weights, 1.01);
}

std::array<std::int32_t, 3>
PartsForBounds(const SpacingWeights & weights)
{
  return FineParts(weights, 0.99);
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
  StagePlan      plan(progress, { 0.6, 0.2, 0.2 });
  ThicknessBalls balls =
    BallsOfCut(CutVoxels(shape, parts), CutWeights(weights, parts), kCutBoundingStep, plan.Next("thickness"));
  const VoxelValues lower = PaintedBy(std::move(balls.inscribed), shape, weights, parts, plan.Next("thickness"));
  const VoxelValues upper = PaintedBy(std::move(balls.bounding), shape, weights, parts, plan.Next("thickness"));
  for (std::size_t i = 0; i < lower.values.size(); ++i)
  {
    bracket.lower.values[i] = std::max(bracket.lower.values[i], lower.values[i]);
    bracket.upper.values[i] = std::min(bracket.upper.values[i], upper.values[i]);
  }
}

ThicknessBracket
SmoothBracket(const VoxelShape & shape, const SpacingWeights & weights, const ProgressCallback & progress)
{
  StagePlan                         plan(progress, { 0.4, 0.05, 0.5, 0.05 });
  const std::array<std::int32_t, 3> parts = PartsForBounds(shape, weights);
  const SpacingWeights              fine = CutWeights(weights, parts);
  ThicknessBracket                  bracket;
  bracket.lower =
    PaintedBy(BallsOfCut(PartsReaching(shape, parts, Reaching::All), fine, 0, plan.Next("thickness")).inscribed,
              shape,
              weights,
              parts,
              plan.Next("thickness"));
  bracket.upper = PaintedBy(
    BallsOfCut(PartsReaching(shape, parts, Reaching::Any), fine, kCutBoundingStep, plan.Next("thickness")).bounding,
    shape,
    weights,
    parts,
    plan.Next("thickness"));
  return bracket;
}

} // namespace voxelcore
