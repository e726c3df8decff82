#include "VoxelCoreTesting/Random.h"

#include "voxelcore/Thickness/ThicknessNumbers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numeric>

namespace voxelcore
{
namespace
{

TEST(ThicknessNumbers, OfTenVoxelsAreThoseOneCanCount)
{
  const ThicknessNumbers n = SummarizeThickness({ 1, 2, 3, 4, 5, 6, 7, 8, 9, 10 }, 2);
  EXPECT_EQ(n.voxels, 10U);
  EXPECT_DOUBLE_EQ(n.mean, 5.5);
  EXPECT_DOUBLE_EQ(n.deviation, std::sqrt(8.25));
  EXPECT_EQ(n.least, 1);
  EXPECT_EQ(n.quantile5, 1);
  EXPECT_EQ(n.quantile25, 3);
  EXPECT_EQ(n.median, 5);
  EXPECT_EQ(n.quantile75, 8);
  EXPECT_EQ(n.quantile95, 10);
  EXPECT_EQ(n.greatest, 10);
  EXPECT_EQ(n.binWidth, 2);
  EXPECT_EQ(n.bins, (std::vector<std::uint64_t>{ 1, 2, 2, 2, 2, 1 }));
}

TEST(ThicknessNumbers, OfNothingAreZero)
{
  const ThicknessNumbers n = SummarizeThickness({}, 1);
  EXPECT_EQ(n.voxels, 0U);
  EXPECT_TRUE(std::isnan(n.mean)) << "nothing is not 0 mm thick";
  EXPECT_TRUE(n.bins.empty());
}

TEST(ThicknessNumbers, BinsHoldAllVoxelsAndAreAtMostTwoHundred)
{
  std::cout << "seed 8300\n";
  testing::Random random(8300);
  for (int run = 0; run < 50; ++run)
  {
    std::vector<float> values;
    const double       scale = std::pow(10.0, 4 * random.Unit());
    for (int i = 0; i < 500; ++i)
    {
      values.push_back(static_cast<float>(scale * random.Unit() + 1e-3));
    }
    const ThicknessNumbers n = SummarizeThickness(values, 0.5);
    EXPECT_LE(n.bins.size(), 200U);
    EXPECT_EQ(std::accumulate(n.bins.begin(), n.bins.end(), std::uint64_t{ 0 }), values.size());
    EXPECT_GT(n.bins.back(), 0U);
    EXPECT_LE(n.quantile5, n.quantile25);
    EXPECT_LE(n.quantile25, n.median);
    EXPECT_LE(n.median, n.quantile75);
    EXPECT_LE(n.quantile75, n.quantile95);
    const auto thinner = std::count_if(values.begin(), values.end(), [&](float v) { return v <= n.quantile25; });
    EXPECT_EQ(thinner, 125);
  }
}

} // namespace
} // namespace voxelcore
