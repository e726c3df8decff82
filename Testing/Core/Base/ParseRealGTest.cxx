#include "voxelcore/Base/ParseReal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace voxelcore
{
namespace
{

TEST(ParseReal, NumbersAreReadWhole)
{
  EXPECT_EQ(ParseReal("1.5"), 1.5);
  EXPECT_EQ(ParseReal("+1"), 1.0);
  EXPECT_EQ(ParseReal("-2e3"), -2000.0);
  EXPECT_EQ(ParseReal("1.7976931348623157e308"), std::numeric_limits<double>::max());
  EXPECT_EQ(ParseReal("4.9406564584124654e-324"), std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(ParseReal("inf"), std::numeric_limits<double>::infinity());
  EXPECT_EQ(ParseReal("-inf"), -std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(*ParseReal("nan")));
}

TEST(ParseReal, OneSignAtMostAndNothingLeftOver)
{
  for (const char * text : { "", "+", "-", "+-1", "-+1", "++1", "--1", "1x", "1 ", " 1", "1,5", "e5", "0x10", "1e" })
  {
    EXPECT_EQ(ParseReal(text), std::nullopt) << text;
  }
}

TEST(ParseReal, TooLargeIsRefusedAndTooSmallIsZero)
{
  for (const std::string sign : { "", "-", "+" })
  {
    for (const std::string & text : { std::string("1e400"),
                                      std::string("0.1e400"),
                                      std::string("1E+99999999999999999999"),
                                      std::string(400, '9') })
    {
      EXPECT_EQ(ParseReal(sign + text), std::nullopt) << text;
    }
    for (const std::string & text : { std::string("1e-400"),
                                      std::string("1000e-400"),
                                      std::string("1e-99999999999999999999"),
                                      "0." + std::string(400, '0') + "1",
                                      "0." + std::string(400, '0') + "1e+5" })
    {
      EXPECT_EQ(ParseReal(sign + text), 0.0) << text;
    }
  }
}

} // namespace
} // namespace voxelcore
