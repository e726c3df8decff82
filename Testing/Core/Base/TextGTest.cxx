#include "voxelcore/Base/Text.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>

namespace voxelcore
{

TEST(Text, OnlyZeroReadsAsZero)
{
  EXPECT_EQ(FixedText(0), "0.00");
  EXPECT_EQ(FixedText(12.345), "12.35");
  EXPECT_EQ(FixedText(0.5), "0.50");
  EXPECT_EQ(FixedText(0.0312), "0.031");
  EXPECT_EQ(FixedText(-0.00021, 3), "-0.00021");
  EXPECT_EQ(FixedText(3, 0), "3");
  for (double value = 1e-300; value < 1e300; value *= 3.7)
  {
    EXPECT_NEAR(std::stod(FixedText(value)), value, 0.051 * value) << value;
  }
}

TEST(Text, RoughNumbersHaveNoExponent)
{
  EXPECT_EQ(RoughText(0.0123), "0.012");
  EXPECT_EQ(RoughText(3.44), "3.4");
  EXPECT_EQ(RoughText(97.6), "98");
  EXPECT_EQ(RoughText(100), "100");
  EXPECT_EQ(RoughText(123456), "123456");
}

TEST(Text, EveryPartIsThereAlsoEmptyOnes)
{
  using Parts = std::vector<std::string>;
  EXPECT_EQ(SplitText("1mm,2vox,3%", ','), (Parts{ "1mm", "2vox", "3%" }));
  EXPECT_EQ(SplitText(",a,", ','), (Parts{ "", "a", "" }));
  EXPECT_EQ(SplitText("", ','), Parts{ "" });
}

TEST(Text, ANumberIsTheSameWhenReadAgain)
{
  for (const double value : { 0.1, -1 / 3., 12.5, 1e300, std::numeric_limits<double>::denorm_min() })
  {
    EXPECT_EQ(std::strtod(RoundTripText(value).c_str(), nullptr), value) << value;
  }
  EXPECT_EQ(RoundTripText(0.1), "0.1");
}

} // namespace voxelcore
