#include "VoxelCoreTesting/Random.h"

#include "voxelcore/Labels/ScaledValue.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <iostream>
#include <limits>

namespace voxelcore::testing
{
namespace
{

/** Up to here the rounding of a slope is below a hundredth of it. */
constexpr std::int64_t kFarthest = (1 << 24) / 100;

double
Scaled(double slope, double intercept, double stored)
{
  StoredVoxels scan;
  scan.slope = slope;
  scan.intercept = intercept;
  return ScaledValue(scan, stored);
}

TEST(ScaledValue, MultiplesOfASlopesDenominatorAreWhole)
{
  // 1/n, in single precision as NIfTI-1 stores it and in double precision.
  for (int n = 1; n <= 1000; ++n)
  {
    for (const double slope : { static_cast<double>(1.0F / static_cast<float>(n)), 1.0 / n })
    {
      for (const int k : { 1, 2, 3, 7, 100, 255, 1000, 4000 })
      {
        if (k * n > kFarthest)
        {
          continue;
        }
        ASSERT_EQ(Scaled(slope, 0, k * n), k) << "1/" << n;
        ASSERT_EQ(Scaled(-slope, 0, k * n), -k) << "-1/" << n;
        ASSERT_EQ(Scaled(slope, -3, k * n), k - 3) << "1/" << n << " - 3";
      }
    }
  }
  EXPECT_EQ(Scaled(0.1F, -0.1F, 11), 1); // the intercept is rounded, too
  EXPECT_EQ(Scaled(0.1F, 0.3F, 7), 1);
}

TEST(ScaledValue, WhatTheRoundingOfTheSlopeDoesNotExplainStays)
{
  constexpr std::uint64_t seed = 20261122;
  std::cout << "seed " << seed << '\n';
  Random random(seed);
  int    moved = 0;
  for (int i = 0; i < 200000; ++i)
  {
    const int    n = static_cast<int>(random.Between(2, 60000));
    const double slope = 1.0F / static_cast<float>(n);
    const auto   stored = static_cast<double>(random.Between(-kFarthest, kFarthest));
    const double product = slope * stored;
    const double value = Scaled(slope, 0, stored);
    if (static_cast<std::int64_t>(stored) % n == 0)
    {
      ASSERT_EQ(value, stored / n) << stored << " / " << n;
      ++moved;
    }
    else
    {
      // A fraction of n is at least 1/n from any whole number, which is more than the slope is off.
      ASSERT_EQ(value, product) << stored << " / " << n;
    }
  }
  EXPECT_GT(moved, 10) << "some are multiples";
  EXPECT_EQ(Scaled(0.5, 0, 3), 1.5);
  EXPECT_EQ(Scaled(1, 1e-3, 1), 1.001);
  EXPECT_EQ(Scaled(1, -1e-7, 1), 1 - 1e-7); // no slope that could be off
}

TEST(ScaledValue, UnscaledAndEndlessValuesStay)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double stored : { 0.0, 1.0, 0.99999999, -2.5, 1e300, 0x1p53 - 1, infinity, -infinity })
  {
    EXPECT_EQ(Scaled(1, 0, stored), stored);
  }
  EXPECT_TRUE(std::isnan(Scaled(1.0 / 255, 0, std::numeric_limits<double>::quiet_NaN())));
  EXPECT_EQ(Scaled(1.0F / 3, 0, infinity), infinity);
  // Farther out the rounding of a slope says less and less about a product.
  EXPECT_EQ(Scaled(1.0F / 3, 0, 167772), 55924);
  EXPECT_EQ(Scaled(1.0F / 3, 0, 167775), static_cast<double>(1.0F / 3) * 167775);
}

} // namespace
} // namespace voxelcore::testing
