// Colours that can be told apart, and a map that means the same everywhere.

#include "voxelcore/Models/DisplayColors.h"

#include <algorithm>
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

/** Of a colour as someone sees it who lacks one of the three kinds of cones (Machado, Oliveira, Fernandes 2009). */
Color
SeenWithout(int cones, const Color & color)
{
  constexpr std::array<std::array<double, 9>, 3> matrices{ {
    { 0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882, -0.048116, 1.051998 },
    { 0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.011820, 0.042940, 0.968881 },
    { 1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602, 0.004733, 0.691367, 0.303900 },
  } };
  Color                                          seen{};
  for (std::size_t row = 0; row < 3; ++row)
  {
    double linear = 0;
    for (std::size_t k = 0; k < 3; ++k)
    {
      linear += matrices[static_cast<std::size_t>(cones)][3 * row + k] * std::pow(color[k], 2.2);
    }
    seen[row] = std::pow(std::clamp(linear, 0.0, 1.0), 1 / 2.2);
  }
  return seen;
}

TEST(DisplayColors, TheMapIsTheMiddleOfPlasma)
{
  // Entries 57, 102, 153 and 201 of the published table of 256.
  const std::pair<double, Color> published[] = { { 57 / 255.0, { 0.453677, 0.002755, 0.660310 } },
                                                 { 102 / 255.0, { 0.692840, 0.165141, 0.564522 } },
                                                 { 153 / 255.0, { 0.881443, 0.392529, 0.383229 } },
                                                 { 201 / 255.0, { 0.988648, 0.617690, 0.235080 } } };
  for (const auto & [at, color] : published)
  {
    EXPECT_LT(Difference(LengthColor((at - 0.22) / (0.79 - 0.22)), color), 5) << at;
  }
  EXPECT_EQ(LengthColor(-5), LengthColor(0));
  EXPECT_EQ(LengthColor(7), LengthColor(1));
}

TEST(DisplayColors, EveryColorOfTheMapStandsOutFromWhiteAndFromBlack)
{
  EXPECT_NEAR(Contrast({ 0, 0, 0 }, { 1, 1, 1 }), 21, 0.01);
  EXPECT_NEAR(Contrast({ 1, 0, 0 }, { 1, 1, 1 }), 4.0, 0.01);
  for (int step = 0; step <= 100; ++step)
  {
    EXPECT_GE(Contrast(LengthColor(step / 100.0), { 1, 1, 1 }), 2) << step;
    EXPECT_GE(Contrast(LengthColor(step / 100.0), { 0, 0, 0 }), 2) << step;
  }
}

TEST(DisplayColors, EqualStepsOfTheMapLookEqualAndGrowLighter)
{
  constexpr int kSteps = 32;
  double        least = 1e9;
  double        most = 0;
  for (int step = 1; step < kSteps; ++step)
  {
    const Color before = LengthColor((step - 1.0) / (kSteps - 1));
    const Color now = LengthColor(step / (kSteps - 1.0));
    EXPECT_GT(ToLab(now)[0], ToLab(before)[0]) << step; // so it reads in grey as well
    least = std::min(least, Difference(before, now));
    most = std::max(most, Difference(before, now));
  }
  EXPECT_LT(most, 2.2 * least);
}

TEST(DisplayColors, TheMapIsReadWithAnyColorBlindness)
{
  for (int cones = 0; cones < 3; ++cones)
  {
    for (int step = 0; step < 8; ++step)
    {
      const Color a = SeenWithout(cones, LengthColor(step / 8.0));
      const Color b = SeenWithout(cones, LengthColor((step + 1) / 8.0));
      EXPECT_GT(Difference(a, b), 5) << cones << ", " << step;
    }
  }
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
