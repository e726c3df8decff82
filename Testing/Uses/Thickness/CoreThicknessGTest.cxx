#include "VoxelCoreTesting/Shapes.h"
#include "VoxelCoreTesting/Threads.h"

#include "voxelcore/Thickness/CoreThickness.h"
#include "voxelcore/VoxelCore/VoxelCore.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace voxelcore
{
namespace
{

using testing::Box;
using testing::RandomVolume;
using testing::RandomVolumes;
using testing::ShapeWhere;

TEST(CoreThickness, RanksCountTheVoxelsBefore)
{
  for (const RandomVolume & volume : RandomVolumes(8100, 20))
  {
    SCOPED_TRACE(volume.Describe());
    const VoxelRanks ranks(volume.shape);
    const auto &     box = volume.shape.Box();
    std::size_t      count = 0;
    for (std::int32_t z = box.lower[2]; z < box.lower[2] + box.size[2]; ++z)
    {
      for (std::int32_t y = box.lower[1]; y < box.lower[1] + box.size[1]; ++y)
      {
        for (std::int32_t x = box.lower[0]; x < box.lower[0] + box.size[0]; ++x)
        {
          if (volume.shape.Contains(x, y, z))
          {
            ASSERT_EQ(ranks.At(x, y, z), count++);
          }
        }
      }
    }
  }
}

TEST(CoreThickness, EveryVoxelBelongsToTheFirstOfTheGreatestBallsThatHoldIt)
{
  for (const RandomVolume & volume : RandomVolumes(8200, 40))
  {
    SCOPED_TRACE(volume.Describe());
    const SpacingWeights weights = ComputeSpacingWeights(volume.spacing);
    const PaintingBalls  balls = BallsOfCore(ComputeVoxelCore(volume.shape, weights));
    VoxelOwners          owners = ZeroAtVoxels<std::uint32_t>(volume.shape);
    PaintOwners(volume.shape, weights, balls, owners);
    const auto & box = volume.shape.Box();
    std::size_t  at = 0;
    for (std::int32_t z = 0; z < box.size[2]; ++z)
    {
      for (std::int32_t y = 0; y < box.size[1]; ++y)
      {
        for (std::int32_t x = 0; x < box.size[0]; ++x)
        {
          if (!volume.shape.Contains(box.lower[0] + x, box.lower[1] + y, box.lower[2] + z))
          {
            continue;
          }
          std::uint32_t best = 0;
          const Vector3 centre{ box.lower[0] + x + 0.5, box.lower[1] + y + 0.5, box.lower[2] + z + 0.5 };
          for (std::uint32_t i = 0; i < balls.Count(); ++i)
          {
            double squared = 0;
            for (std::size_t k = 0; k < 3; ++k)
            {
              const double d =
                (centre[k] - balls.centres[i][k]) * static_cast<double>(weights.weight[k]) * weights.unit;
              squared += d * d;
            }
            if (squared <= balls.radius[i] * balls.radius[i] * (1 + 2e-10) &&
                (best == 0 || balls.value[i] > balls.value[best - 1]))
            {
              best = i + 1;
            }
          }
          ASSERT_EQ(owners.values[at++], best);
        }
      }
    }
  }
}

TEST(CoreThickness, WhatNoBallHoldsTakesTheNearestVoxelsBall)
{
  // One ball in the middle of a bar: all of the bar is its; a second bar, apart, keeps none.
  const VoxelShape     shape = ShapeWhere({ 21, 3, 9 }, [](int, int, int z) { return z < 3 || z > 5; });
  const SpacingWeights weights = ComputeSpacingWeights({ 1, 1, 1 });
  PaintingBalls        balls;
  balls.Add({ 10.5, 1.5, 1.5 }, 1.5, 1.5);
  const VoxelOwners owners = OwnersAmong(balls, shape, weights);
  const VoxelValues map = ThicknessOfOwners(shape, weights, balls, owners);
  const VoxelRanks  ranks(shape);
  for (std::int32_t x = 0; x < 21; ++x)
  {
    EXPECT_EQ(owners.values[ranks.At(x, 0, 2)], 1U);
    EXPECT_EQ(map.values[ranks.At(x, 0, 2)], 3.0F);
    EXPECT_EQ(owners.values[ranks.At(x, 0, 7)], 0U);
  }
  EXPECT_EQ(map.values[ranks.At(10, 1, 7)], 3.0F) << "its own ball";
  EXPECT_EQ(map.values[ranks.At(10, 0, 7)], 1.0F) << "its own ball";
}

TEST(CoreThickness, OfTwoNeighboursTheNearestCountsAndThenTheThickest)
{
  // Thin to the left, thick to the right of a gap of two voxels without a ball.
  const VoxelShape     shape = Box({ 6, 1, 1 });
  const SpacingWeights weights = ComputeSpacingWeights({ 1, 1, 1 });
  PaintingBalls        balls;
  balls.Add({ 0.5, 0.5, 0.5 }, 1.1, 1.1);
  balls.Add({ 5.5, 0.5, 0.5 }, 1.2, 1.2);
  EXPECT_EQ(OwnersAmong(balls, shape, weights).values, (std::vector<std::uint32_t>{ 1, 1, 1, 2, 2, 2 }));
  const VoxelShape odd = Box({ 5, 1, 1 });
  balls.centres[1][0] = 4.5;
  EXPECT_EQ(OwnersAmong(balls, odd, weights).values, (std::vector<std::uint32_t>{ 1, 1, 2, 2, 2 }));
}

TEST(CoreThickness, AValueIsFoundJustOutsideToo)
{
  const VoxelShape shape = Box({ 4, 4, 4 });
  VoxelValues      map = ZeroAtVoxels<float>(shape);
  for (std::size_t i = 0; i < map.values.size(); ++i)
  {
    map.values[i] = static_cast<float>(i + 1);
  }
  const VoxelRanks ranks(shape);
  EXPECT_EQ(ValueNear(shape, ranks, map, { 0.5, 0.5, 0.5 }), 1.0F);
  EXPECT_EQ(ValueNear(shape, ranks, map, { -0.4, 0.5, 0.5 }), 1.0F);
  EXPECT_EQ(ValueNear(shape, ranks, map, { 5.2, 3.5, 3.5 }), 64.0F);
  EXPECT_EQ(ValueNear(shape, ranks, map, { 9.2, 3.5, 3.5 }), 0.0F);
}

TEST(CoreThickness, OwnersAreTheSameForEveryNumberOfThreads)
{
  const VoxelShape     shape = testing::Ellipsoid(40);
  const SpacingWeights weights = ComputeSpacingWeights({ 1, 1, 2 });
  const PaintingBalls  balls = BallsOfCore(ComputeVoxelCore(shape, weights));
  VoxelOwners          one;
  {
    const testing::Threads threads(1);
    one = OwnersAmong(balls, shape, weights);
  }
  const testing::Threads threads(4);
  EXPECT_EQ(one.values, OwnersAmong(balls, shape, weights).values);
}

} // namespace
} // namespace voxelcore
