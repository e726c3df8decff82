#include "voxelcore/Roots/GreyLevels.h"

#include "VoxelCoreTesting/Shapes.h"

#include "voxelcore/Shape/ShapeTopology.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace voxelcore::testing
{
namespace
{

using Grey = std::function<double(int, int, int)>;

BandValues
ValuesOf(const VoxelShape & band, const Grey & grey)
{
  BandValues values(band);
  const auto box = band.Box();
  for (std::int32_t z = box.lower[2]; z < box.lower[2] + box.size[2]; ++z)
  {
    for (std::int32_t y = box.lower[1]; y < box.lower[1] + box.size[1]; ++y)
    {
      std::vector<float> row;
      for (std::int32_t x = box.lower[0]; x < box.lower[0] + box.size[0]; ++x)
      {
        row.push_back(static_cast<float>(grey(x, y, z)));
      }
      values.SetRow(y, z, row);
    }
  }
  return values;
}

TEST(GreyLevels, TheBandKeepsTheValuesOfItsVoxels)
{
  const std::uint64_t seed = std::random_device{}();
  Random              random(seed);
  const VoxelShape    band = RandomShape(random, { 150, 6, 5 }, 0.4);
  const auto          grey = [](int x, int y, int z) { return x + 1000.0 * y + 10000.0 * z; };
  const BandValues    values = ValuesOf(band, grey);
  EXPECT_EQ(values.All().size(), band.CountVoxels());
  for (int z = 0; z < 5; ++z)
  {
    for (int y = 0; y < 6; ++y)
    {
      for (int x = 0; x < 150; ++x)
      {
        if (band.Contains(x, y, z))
        {
          ASSERT_EQ(values.At(x, y, z), static_cast<float>(grey(x, y, z))) << "seed " << seed;
        }
      }
    }
  }
}

/** A ring in the plane z = 2, 100 bright, whose one side is dark at `weak`; background 0. */
double
WeakRing(int x, int y, int z, double weak)
{
  const double radius = std::hypot(x - 15.0, y - 15.0);
  const bool   isIn = radius >= 7 && radius < 11 && z >= 1 && z <= 3;
  return !isIn ? 0 : x > 20 && std::abs(y - 15) < 2 ? weak : 100;
}

TEST(GreyLevels, TheKernelIsTheLowestLevelAtWhichALoopIsOpen)
{
  const Size3      size{ 31, 31, 5 };
  const VoxelShape shape = ShapeWhere(size, [](int x, int y, int z) { return WeakRing(x, y, z, 70) >= 50; });
  const BandValues values = ValuesOf(Box(size), [](int x, int y, int z) { return WeakRing(x, y, z, 70); });
  EXPECT_EQ(ComputeShapeTopology(shape).betti, (std::array<std::int64_t, 3>{ 1, 1, 0 }));
  const GreyLevels levels = ProposeLevels(shape, values, 50);
  EXPECT_EQ(levels.background, 0);
  EXPECT_EQ(levels.bright, 100);
  EXPECT_GT(levels.kernel, 70) << "the weak side has 70";
  EXPECT_LE(levels.kernel, 80);
  EXPECT_GT(levels.otsu, 0);
  EXPECT_LT(levels.otsu, 100);
  EXPECT_GT(levels.valley, 0);
  EXPECT_LT(levels.valley, 100);
  ASSERT_EQ(levels.tried.size(), 7U);
  for (const LevelNumbers & one : levels.tried)
  {
    EXPECT_EQ(one.numbers.betti[1], one.level > 70 ? 0 : 1) << one.level;
  }
}

TEST(GreyLevels, TheNeighbourhoodIsTheHighestLevelAtWhichTheNumbersAreFewest)
{
  const Size3      size{ 31, 31, 5 };
  const auto       grey = [](int x, int y, int z) { return x == 15 && y == 6 && z == 2 ? 42 : WeakRing(x, y, z, 35); };
  const VoxelShape shape = ShapeWhere(size, [&](int x, int y, int z) { return grey(x, y, z) >= 50; });
  // Open at the weak side, with a cavity that closes at 40.
  EXPECT_EQ(ComputeShapeTopology(shape).betti, (std::array<std::int64_t, 3>{ 1, 0, 1 }));
  const GreyLevels levels = ProposeLevels(shape, ValuesOf(Box(size), grey), 50);
  EXPECT_EQ(levels.neighbourhood, 40) << "there the cavity is filled, and at 30 the ring would close";
}

TEST(GreyLevels, WhatWasFilledStaysAndWhatWasTakenOutComesNotBack)
{
  const Size3      size{ 9, 9, 9 };
  const VoxelShape band = Box(size);
  // Bright, with a dark middle that the shape has filled, and a bright corner that it lacks.
  const auto       grey = [](int x, int y, int z) { return x == 4 && y == 4 && z == 4 ? 0.0 : 100.0; };
  const VoxelShape shape = ShapeWhere(size, [](int x, int y, int z) { return x + y + z > 0; });
  const VoxelShape high = AtLeast(shape, ValuesOf(band, grey), 50, 90);
  EXPECT_TRUE(high.Contains(4, 4, 4));
  EXPECT_FALSE(high.Contains(0, 0, 0));
  EXPECT_EQ(high.CountVoxels(), shape.CountVoxels());
}

} // namespace
} // namespace voxelcore::testing
