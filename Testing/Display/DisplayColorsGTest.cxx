// Colours that can be told apart, and a map that means the same everywhere.

#include "voxelcore/DisplayColors.h"

#include <cmath>
#include <gtest/gtest.h>

namespace voxelcore::testing
{
namespace
{

double
Difference(const Color & a, const Color & b)
{
  const auto p = ToLab(a);
  const auto q = ToLab(b);
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

TEST(DisplayColors, LabIsThatOfTheStandardColors)
{
  // White, black and red of sRGB, D65 (Lindbloom's tables).
  EXPECT_NEAR(ToLab({ 1, 1, 1 })[0], 100, 0.01);
  EXPECT_NEAR(ToLab({ 0, 0, 0 })[0], 0, 0.01);
  const auto red = ToLab({ 1, 0, 0 });
  EXPECT_NEAR(red[0], 53.24, 0.05);
  EXPECT_NEAR(red[1], 80.09, 0.05);
  EXPECT_NEAR(red[2], 67.20, 0.05);
}

TEST(DisplayColors, TheMapIsViridis)
{
  // Entries 0, 64, 128, 191 and 255 of the published table of 256.
  const std::pair<double, Color> published[] = { { 0.0, { 0.267004, 0.004874, 0.329415 } },
                                                 { 64 / 255.0, { 0.229739, 0.322361, 0.545706 } },
                                                 { 128 / 255.0, { 0.127568, 0.566949, 0.550556 } },
                                                 { 191 / 255.0, { 0.360741, 0.785964, 0.387814 } },
                                                 { 1.0, { 0.993248, 0.906157, 0.143936 } } };
  for (const auto & [t, color] : published)
  {
    EXPECT_LT(Difference(ViridisColor(t), color), 3) << t;
  }
  EXPECT_EQ(ViridisColor(-5), ViridisColor(0));
  EXPECT_EQ(ViridisColor(7), ViridisColor(1));
}

TEST(DisplayColors, EqualStepsOfTheMapLookEqualAndGrowLighter)
{
  constexpr int kSteps = 32;
  double        least = 1e9;
  double        most = 0;
  for (int step = 1; step < kSteps; ++step)
  {
    const Color before = ViridisColor((step - 1.0) / (kSteps - 1));
    const Color now = ViridisColor(step / (kSteps - 1.0));
    EXPECT_GT(ToLab(now)[0], ToLab(before)[0]) << step; // so it reads in grey as well
    least = std::min(least, Difference(before, now));
    most = std::max(most, Difference(before, now));
  }
  EXPECT_LT(most, 3.5 * least);
}

TEST(DisplayColors, LabelsCanBeToldApartFromEachOtherAndFromTheBackground)
{
  for (std::int64_t a = 1; a <= 255; ++a)
  {
    const double farEnough = a <= 12 ? 40 : a <= 32 ? 20 : a <= 116 ? 8 : 4;
    for (std::int64_t b = 1; b < a; ++b)
    {
      EXPECT_GT(Difference(LabelColor(a), LabelColor(b)), farEnough) << a << " and " << b;
    }
    EXPECT_GT(Difference(LabelColor(a), { 1, 1, 1 }), 20);
    EXPECT_GT(Difference(LabelColor(a), { 0, 0, 0 }), 20);
  }
}

TEST(DisplayColors, ALabelAlwaysHasTheSameColor)
{
  EXPECT_EQ(LabelColor(7), LabelColor(7));
  EXPECT_EQ(LabelColor(7), LabelColor(7 + 255));
  EXPECT_EQ(LabelColor(std::int64_t{ 1 } << 40), LabelColor(std::int64_t{ 1 } << 40));
}

} // namespace
} // namespace voxelcore::testing
