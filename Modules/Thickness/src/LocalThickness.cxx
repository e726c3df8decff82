#include "voxelcore/LocalThickness.h"

#include "RodPainter.h"
#include "SquareTree.h"

#include "voxelcore/ParallelTasks.h"
#include "voxelcore/StagePlan.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

namespace voxelcore
{

namespace
{

Vector3
WeightsOf(const SpacingWeights & weights)
{
  return { static_cast<double>(weights.weight[0]),
           static_cast<double>(weights.weight[1]),
           static_cast<double>(weights.weight[2]) };
}

/** In the order they are painted: the greatest value first, of equal ones the first. */
std::vector<PaintedBall>
InOrder(const PaintingBalls & balls, const VoxelBox & box, const SpacingWeights & weights)
{
  constexpr double           greater = 1 + 1e-10;
  std::vector<std::uint32_t> order(balls.Count());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return balls.value[a] != balls.value[b] ? balls.value[a] > balls.value[b] : a < b;
  });
  std::vector<PaintedBall> sorted;
  sorted.reserve(order.size());
  for (const std::uint32_t i : order)
  {
    const double radius = balls.radius[i] / weights.unit * greater;
    PaintedBall  ball{ balls.centres[i], radius * radius, static_cast<float>(2 * balls.value[i]), i };
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      ball.centre[axis] -= box.lower[axis];
    }
    sorted.push_back(ball);
  }
  return sorted;
}

/** The blocks of 16 that a ball may touch along an axis: first and end. */
std::array<std::int32_t, 2>
BlocksOf(const PaintedBall & ball, std::size_t axis, double weight, std::int32_t size)
{
  const double reach = std::sqrt(ball.squared) / weight + 1;
  const double blocks = (size + kAlong - 1) / kAlong;
  return { static_cast<std::int32_t>(std::clamp(std::floor((ball.centre[axis] - reach) / kAlong), 0.0, blocks)),
           static_cast<std::int32_t>(std::clamp(std::floor((ball.centre[axis] + reach) / kAlong) + 1, 0.0, blocks)) };
}

} // namespace

template <typename T>
VoxelField<T>
ZeroAtVoxels(const VoxelShape & shape)
{
  VoxelField<T> map;
  const auto &  size = shape.Box().size;
  std::uint64_t count = 0;
  map.box = shape.Box();
  map.rowStarts.reserve(static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(size[2]) + 1);
  for (std::int32_t z = 0; z < size[2]; ++z)
  {
    for (std::int32_t y = 0; y < size[1]; ++y)
    {
      for (const std::uint64_t word : shape.Row(y, z))
      {
        count += static_cast<std::uint64_t>(std::popcount(word));
      }
      map.rowStarts.push_back(count);
    }
  }
  map.values.assign(count, T{ 0 });
  return map;
}

template VoxelField<float>
ZeroAtVoxels(const VoxelShape & shape);
template VoxelField<std::uint32_t>
ZeroAtVoxels(const VoxelShape & shape);

namespace
{

template <typename T>
void
PaintBalls(const VoxelShape &       shape,
           const SpacingWeights &   weights,
           const PaintingBalls &    balls,
           VoxelField<T> &          map,
           const ProgressCallback & progress)
{
  const Vector3                            sides = WeightsOf(weights);
  const auto &                             size = shape.Box().size;
  const std::vector<PaintedBall>           sorted = InOrder(balls, shape.Box(), weights);
  std::vector<std::array<std::int32_t, 2>> slabsOf;
  slabsOf.reserve(sorted.size());
  for (const PaintedBall & ball : sorted)
  {
    slabsOf.push_back(BlocksOf(ball, 2, sides[2], size[2]));
  }
  const auto rods = static_cast<std::size_t>((size[1] + kAlong - 1) / kAlong);
  for (std::int32_t slab = 0; slab * kAlong < size[2]; ++slab)
  {
    ReportProgress(progress, "thickness", static_cast<double>(slab) * kAlong / size[2]);
    std::vector<std::vector<std::uint32_t>> chosen(rods);
    for (std::size_t i = 0; i < sorted.size(); ++i)
    {
      if (slabsOf[i][0] <= slab && slab < slabsOf[i][1])
      {
        const auto range = BlocksOf(sorted[i], 1, sides[1], size[1]);
        for (std::int32_t rod = range[0]; rod < range[1]; ++rod)
        {
          chosen[static_cast<std::size_t>(rod)].push_back(static_cast<std::uint32_t>(i));
        }
      }
    }
    RunEach(rods, [&](std::size_t rod) {
      RodPainter<T>(shape, sides, map)
        .Paint(static_cast<std::int32_t>(rod) * kAlong, slab * kAlong, sorted, chosen[rod]);
    });
  }
}

} // namespace

void
PaintThickness(const VoxelShape &       shape,
               const SpacingWeights &   weights,
               const PaintingBalls &    balls,
               VoxelValues &            map,
               const ProgressCallback & progress)
{
  PaintBalls(shape, weights, balls, map, progress);
}

void
PaintOwners(const VoxelShape &       shape,
            const SpacingWeights &   weights,
            const PaintingBalls &    balls,
            VoxelOwners &            owners,
            const ProgressCallback & progress)
{
  PaintBalls(shape, weights, balls, owners, progress);
}

void
FillWithOwnBalls(const VoxelShape & shape, const SpacingWeights & weights, VoxelValues & map)
{
  if (std::find(map.values.begin(), map.values.end(), 0.0F) == map.values.end())
  {
    return;
  }
  const SquareTree tree(shape, weights);
  const auto &     box = shape.Box();
  const double     far = std::numeric_limits<double>::infinity();
  for (std::int32_t z = 0; z < box.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < box.size[1]; ++y)
    {
      const auto row =
        static_cast<std::size_t>(z) * static_cast<std::size_t>(box.size[1]) + static_cast<std::size_t>(y);
      std::size_t at = map.rowStarts[row];
      const auto  bits = shape.Row(y, z);
      for (std::size_t word = 0; word < bits.size(); ++word)
      {
        for (std::uint64_t rest = bits[word]; rest != 0; rest &= rest - 1, ++at)
        {
          if (map.values[at] == 0)
          {
            const auto    x = static_cast<std::int32_t>(64 * word) + std::countr_zero(rest);
            const Vector3 centre{ box.lower[0] + x + 0.5, box.lower[1] + y + 0.5, box.lower[2] + z + 0.5 };
            map.values[at] = static_cast<float>(2 * weights.unit * tree.Distance(centre, far));
          }
        }
      }
    }
  }
}

ThicknessBracket
BracketThickness(const VoxelShape &            shape,
                 std::span<const LatticePoint> points,
                 const DelaunayCells &         cells,
                 const SpacingWeights &        weights,
                 bool                          upper,
                 const ProgressCallback &      progress)
{
  StagePlan        plan(progress, { 0.4, upper ? 0.3 : 0.6, upper ? 0.3 : 0.0 });
  ThicknessBalls   balls = FindThicknessBalls(shape, points, cells, weights, upper, plan.Next("thickness"));
  ThicknessBracket bracket;
  bracket.lower = ZeroAtVoxels<float>(shape);
  PaintThickness(shape, weights, balls.inscribed, bracket.lower, plan.Next("thickness"));
  FillWithOwnBalls(shape, weights, bracket.lower);
  if (upper)
  {
    balls.inscribed = PaintingBalls();
    bracket.upper = ZeroAtVoxels<float>(shape);
    PaintThickness(shape, weights, balls.bounding, bracket.upper, plan.Next("thickness"));
  }
  return bracket;
}

} // namespace voxelcore
