// Dilation and erosion by distances, against the same by the ball's rows, and closings by large balls.

#include "BallDistances.h"
#include "Core/Shape/FloodFill.h"
#include "VoxelCoreTesting/Shapes.h"

#include "voxelcore/Masks/ShapeClosing.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>

namespace voxelcore::testing
{
namespace
{

/** Of up to `most` times the greatest weight. */
LatticeBall
BallUpTo(std::int64_t most, Random & random, const Spacing3 & spacing)
{
  LatticeBall ball;
  ball.weight = ComputeSpacingWeights(spacing).weight;
  const std::int64_t radius = most * *std::ranges::max_element(ball.weight);
  ball.squaredRadius = random.Between(1, radius * radius);
  return ball;
}

/** On one thread, which for so small shapes is faster. */
void
ExpectAsByRows(std::uint64_t firstSeed, int count)
{
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  for (const RandomVolume & volume : RandomVolumes(firstSeed, count))
  {
    SCOPED_TRACE(volume.Describe());
    Random            random(volume.seed);
    const Size3       size{ static_cast<std::int32_t>(random.Between(1, 90)),
                      static_cast<std::int32_t>(random.Between(1, 12)),
                      static_cast<std::int32_t>(random.Between(1, 12)) };
    const VoxelShape  shape = RandomShape(random, size, 0.004 * static_cast<double>(random.Between(0, 30)));
    const LatticeBall lattice = BallUpTo(4, random, volume.spacing);
    const BallRows    ball(lattice);
    ASSERT_FALSE(DistancesAreFaster(ball, shape.Box()));
    const VoxelShape byRows = Dilated(shape, ball, {});
    VoxelShape       dilated(byRows.Box());
    DilateByDistances(shape, ball, dilated, {});
    ASSERT_EQ(VoxelsOf(dilated), VoxelsOf(byRows));
    VoxelShape closed = shape;
    ErodeByDistances(dilated, ball, closed, {});
    ASSERT_EQ(VoxelsOf(closed), VoxelsOf(CloseShape(shape, lattice).shape));
  }
  omp_set_num_threads(threads);
}

TEST(BallDistances, AreThoseOfTheBallsRows)
{
  ExpectAsByRows(1, 300);
}

TEST(HeavyBallDistances, AreThoseOfTheBallsRows)
{
  ExpectAsByRows(10000, 10000);
}

/** What lies at least so far from the two plates' sides, in the gap between them, is in every ball that reaches it. */
TEST(BallDistances, ABallWiderThanTheScanFillsASlotButForItsRim)
{
  constexpr std::int32_t side = 20;
  const auto             plates = ShapeWhere({ 8, side, side }, [](int x, int, int) { return x < 2 || x >= 6; });
  const LatticeBall      ball{ { 1, 1, 1 }, 300 * 300 };
  ASSERT_TRUE(DistancesAreFaster(BallRows(ball), plates.Box()));
  const EditedShape closed = CloseShape(plates, ball);
  EXPECT_EQ(closed.componentsJoined, 1U);
  // A ball beside the slot, 300 voxels from its rim, touches the rim and is farther from the plates.
  EXPECT_EQ(closed.voxelsAdded, 4U * (side - 2) * (side - 2));
  EXPECT_EQ(CloseShape(closed.shape, ball).voxelsAdded, 0U);
}

/** By the definition: each voxel of the box that no ball free of voxels holds. */
Voxels
ClosedByTrying(const VoxelShape & shape, const LatticeBall & ball)
{
  const BallRows rows(ball);
  const auto &   box = shape.Box();
  const auto     squared = [&](const std::array<std::int32_t, 3> & a, const std::array<std::int32_t, 3> & b) {
    std::int64_t sum = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const std::int64_t way = ball.weight[axis] * (a[axis] - b[axis]);
      sum += way * way;
    }
    return sum;
  };
  const auto all = [](const std::array<std::int32_t, 3> & from, const std::array<std::int32_t, 3> & to) {
    std::vector<std::array<std::int32_t, 3>> places;
    for (std::int32_t z = from[2]; z < to[2]; ++z)
    {
      for (std::int32_t y = from[1]; y < to[1]; ++y)
      {
        for (std::int32_t x = from[0]; x < to[0]; ++x)
        {
          places.push_back({ x, y, z });
        }
      }
    }
    return places;
  };
  std::vector<std::array<std::int32_t, 3>> voxels;
  const auto                               own = all({ 0, 0, 0 }, box.size);
  std::ranges::copy_if(own, std::back_inserter(voxels), [&](const auto & at) {
    return shape.Contains(at[0], at[1], at[2]);
  });
  const auto & reach = rows.reach;
  auto         centres = all({ -reach[0], -reach[1], -reach[2] },
                     { box.size[0] + reach[0], box.size[1] + reach[1], box.size[2] + reach[2] });
  std::erase_if(centres, [&](const auto & centre) {
    return std::ranges::any_of(voxels, [&](const auto & at) { return squared(centre, at) <= ball.squaredRadius; });
  });
  const VoxelShape closed = ShapeWhere(box.size, [&](int x, int y, int z) {
    return std::ranges::none_of(centres, [&](const auto & centre) {
      return squared(centre, { x, y, z }) <= ball.squaredRadius;
    });
  });
  return VoxelsOf(closed);
}

TEST(BallDistances, LargeBallsCloseWhatTheDefinitionSays)
{
  for (std::uint64_t seed = 1; seed <= 6; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random            random(seed);
    const auto &      spacing = TestSpacings()[seed % 3];
    const VoxelShape  shape = RandomShape(random, { 7, 5, 6 }, 0.05 + 0.02 * static_cast<double>(seed));
    const auto        least = ComputeSpacingWeights(spacing).weight[0];
    const LatticeBall ball{ ComputeSpacingWeights(spacing).weight,
                            least * least * static_cast<std::int64_t>(random.Between(40 * 40, 45 * 45)) };
    ASSERT_TRUE(DistancesAreFaster(BallRows(ball), shape.Box()) || spacing != Spacing3({ 1, 1, 1 }));
    EXPECT_EQ(VoxelsOf(CloseShape(shape, ball).shape), ClosedByTrying(shape, ball));
  }
}

TEST(BallDistances, AreTheSameOnAnyNumberOfThreads)
{
  Random            random(5);
  const VoxelShape  shape = RandomShape(random, { 130, 70, 60 }, 0.0005);
  const LatticeBall ball{ { 1, 1, 2 }, 40 * 40 };
  ASSERT_TRUE(DistancesAreFaster(BallRows(ball), shape.Box()));
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const EditedShape closed = CloseShape(shape, ball);
  EXPECT_GT(closed.voxelsAdded, 1000U);
  omp_set_num_threads(5);
  EXPECT_EQ(VoxelsOf(CloseShape(shape, ball).shape), VoxelsOf(closed.shape));
  omp_set_num_threads(before);
}

} // namespace
} // namespace voxelcore::testing
