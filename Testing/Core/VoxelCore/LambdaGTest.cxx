// Thresholds as users write them.

#include "VoxelCoreTesting/Cores.h"

#include "voxelcore/VoxelCore/LambdaPruning.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace voxelcore
{
namespace
{

using testing::Spacing3;
using Unit = Lambda::Unit;

double
InMillimetres(const char * text, const Spacing3 & spacing, const VoxelBox & box = { { 0, 0, 0 }, { 10, 20, 30 } })
{
  return LambdaInMillimetres(ParseLambda(text), ComputeSpacingWeights(spacing), spacing, box);
}

TEST(Lambda, HasAUnitOrIsInMillimetres)
{
  const struct
  {
    const char * text;
    double       value;
    Unit         unit;
  } good[] = {
    { "0", 0, Unit::Millimetre },        { "1.5", 1.5, Unit::Millimetre },  { "1.5mm", 1.5, Unit::Millimetre },
    { "1.5 mm", 1.5, Unit::Millimetre }, { " 2 ", 2, Unit::Millimetre },    { "1.5vox", 1.5, Unit::Voxel },
    { "2.5 vox", 2.5, Unit::Voxel },     { "1e-1vox", 0.1, Unit::Voxel },   { "2.5%", 2.5, Unit::Percent },
    { "2.5 %", 2.5, Unit::Percent },     { ".5mm", 0.5, Unit::Millimetre }, { "5.vox", 5, Unit::Voxel },
    { "0vox", 0, Unit::Voxel },          { "0%", 0, Unit::Percent },        { "1e3", 1000, Unit::Millimetre },
    { "007vox", 7, Unit::Voxel },        { "-0", 0, Unit::Millimetre }
  };
  for (const auto & [text, value, unit] : good)
  {
    const Lambda lambda = ParseLambda(text);
    EXPECT_EQ(lambda.value, value) << text;
    EXPECT_EQ(lambda.unit, unit) << text;
    EXPECT_EQ(lambda.text.find(' '), std::string::npos) << text;
  }
  EXPECT_EQ(ParseLambda("2.5 vox").text, "2.5vox");
}

TEST(Lambda, WithoutSenseIsRefusedByQuotingIt)
{
  for (const char * text :
       { "3apples", "-1",  "-1mm", "-0.5vox", "nan",  "NaN",    "inf",      "infinity", "-inf",  "",      " ",
         "mm",      "vox", "%",    "1,5mm",   "1.5m", "1.5cm",  "1.5MM",    "1.5voxel", "1.5%%", "1 2",   "0x10",
         "1e999",   "1e",  "--1",  "+1",      "1..5", "1.5mmx", "1.5voxes", "1/2",      "1.5px", "nanmm", "infvox" })
  {
    try
    {
      const Lambda lambda = ParseLambda(text);
      ADD_FAILURE() << "'" << text << "' was read as " << lambda.value << " of '" << lambda.text << "'";
    }
    catch (const UsageError & error)
    {
      const std::string message = error.what();
      EXPECT_NE(message.find("'" + std::string(text) + "'"), std::string::npos) << message;
      EXPECT_NE(message.find("vox"), std::string::npos) << message;
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
  }
}

TEST(Lambda, MillimetresAreThemselves)
{
  EXPECT_EQ(InMillimetres("1.25mm", { 0.3, 0.3, 1 }), 1.25);
  EXPECT_EQ(InMillimetres("0.1", { 0.3, 0.3, 1 }), 0.1);
  EXPECT_EQ(InMillimetres("0", { 0.3, 0.3, 1 }), 0.0);
}

TEST(Lambda, VoxelsAreTimesTheSmallestSpacing)
{
  EXPECT_EQ(InMillimetres("2vox", { 1, 1, 1 }), 2.0);
  EXPECT_EQ(InMillimetres("2vox", { 3, 0.5, 1 }), 1.0);
  EXPECT_EQ(InMillimetres("0vox", { 3, 0.5, 1 }), 0.0);
  EXPECT_NEAR(InMillimetres("2.5vox", { 0.48828125, 0.48828125, 2.5 }), 2.5 * 0.48828125, 1e-15);
  EXPECT_NEAR(InMillimetres("1e-1vox", { 2, 2, 3 }), 0.2, 1e-15);
  EXPECT_NEAR(InMillimetres("0.123456789012345678vox", { 2, 2, 2 }), 0.24691357802469135, 1e-15);
  EXPECT_NEAR(InMillimetres("100000vox", { 2, 2, 2 }), 200000.0, 1e-9);
}

TEST(Lambda, PercentAreOfTheLongestSideOfTheBoundingBox)
{
  // 30 voxels of 1 mm against 20 of 2 mm.
  EXPECT_DOUBLE_EQ(InMillimetres("2.5%", { 1, 2, 1 }), 1.0);
  EXPECT_DOUBLE_EQ(InMillimetres("10%", { 1, 1, 1 }), 3.0);
  EXPECT_EQ(InMillimetres("0%", { 1, 1, 1 }), 0.0);
}

TEST(Lambda, TheSameNumberWrittenOtherwiseIsTheSameThreshold)
{
  for (const Spacing3 & spacing : testing::TestSpacings())
  {
    EXPECT_EQ(InMillimetres("1.5vox", spacing), InMillimetres("1.500vox", spacing));
    EXPECT_EQ(InMillimetres("1.5vox", spacing), InMillimetres("001.5vox", spacing));
    EXPECT_EQ(InMillimetres("1.5vox", spacing), InMillimetres("15e-1vox", spacing));
    EXPECT_EQ(InMillimetres("2vox", spacing), InMillimetres("2.vox", spacing));
  }
}

TEST(Lambda, InVoxelsTiesWithSlabsOfWholeVoxelsExactly)
{
  testing::Random random(7);
  for (int round = 0; round < 400; ++round)
  {
    // Slabs across the axis of the smallest spacing: face measures are half their thickness.
    Spacing3 spacing{ 0.05 + 2 * random.Unit(), 0, 0 };
    if (round % 2 == 0)
    {
      spacing = { 0.01 * static_cast<double>(random.Between(5, 300)), 0, 0 };
    }
    spacing[1] = spacing[0] * (round % 3 == 0 ? 1.0 : 1.0 + random.Unit());
    spacing[2] = spacing[0] * (round % 3 == 1 ? 1.0 : 1.0 + 3 * random.Unit());
    const auto          thickness = static_cast<std::int32_t>(random.Between(1, 5));
    const MedialComplex core = testing::CoreOf(testing::Box({ thickness, 16, 16 }), spacing);
    const std::string   half = std::to_string(thickness / 2) + (thickness % 2 == 0 ? "vox" : ".5vox");
    const double        lambda = InMillimetres(half.c_str(), spacing);
    // 17 by 17 lattice points, less at most three rows at each rim.
    ASSERT_GE(std::count(core.faceLambda.begin(), core.faceLambda.end(), lambda), 11 * 11)
      << half << " at " << spacing[0] << " : " << spacing[1] << " : " << spacing[2];
  }
}

} // namespace
} // namespace voxelcore
