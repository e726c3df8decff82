// What is said of a colour map's range.

#include "ColorBar.h"

#include <gtest/gtest.h>

namespace voxelcore::testing
{
namespace
{

std::string
WordsAt(const ColorBar & bar, double place)
{
  for (const auto & [at, words] : bar.ticks)
  {
    if (at == place)
    {
      return words;
    }
  }
  return "";
}

TEST(ColorBar, SaysWhatLiesBeyondItsEndsAndWhy)
{
  const ColorBar bar = DescribeColorBar({}, { 1.234, 9.876, 0.5, 20 }, false);
  EXPECT_EQ(bar.title, "Radius (mm)");
  EXPECT_EQ(bar.caption, "2 to 98 % of area");
  EXPECT_EQ(WordsAt(bar, 0), "≤ 1.23");
  EXPECT_EQ(WordsAt(bar, 1), "≥ 9.88");
  EXPECT_TRUE(bar.below);
  EXPECT_TRUE(bar.above);
  const ColorBar all = DescribeColorBar({}, { 1, 9, 1, 9 }, false);
  EXPECT_EQ(all.caption, "");
  EXPECT_EQ(WordsAt(all, 0), "1.00");
  EXPECT_EQ(WordsAt(all, 1), "9.00");
  EXPECT_FALSE(all.below || all.above);
  PictureOptions options;
  options.range = { 0, 5 };
  const ColorBar own = DescribeColorBar(options, { 0, 5, 0.5, 20 }, false);
  EXPECT_EQ(own.caption, "");
  EXPECT_EQ(WordsAt(own, 0), "0");
  EXPECT_EQ(WordsAt(own, 1), "≥ 5");
}

TEST(ColorBar, NamesAUnitThatSuitsTheRange)
{
  const ColorBar nanometres = DescribeColorBar({}, { 2e-6, 56.71e-6, 1e-6, 60e-6 }, false);
  EXPECT_EQ(nanometres.title, "Radius (nm)");
  EXPECT_EQ(WordsAt(nanometres, 0), "≤ 2.00");
  EXPECT_EQ(WordsAt(nanometres, 1), "≥ 56.7");
  PictureOptions options;
  options.coloring = PictureColoring::ErosionThickness;
  const ColorBar micrometres = DescribeColorBar(options, { 0, 0.05, 0, 0.05 }, false);
  EXPECT_EQ(micrometres.title, "Erosion thickness (µm)");
  EXPECT_EQ(WordsAt(micrometres, 0.4), "20");
}

TEST(ColorBar, OfEachLabelHasNoLengths)
{
  PictureOptions options;
  const ColorBar bar = DescribeColorBar(options, { 1, 9, 0, 20 }, true);
  EXPECT_EQ(bar.title, "Radius");
  EXPECT_EQ(bar.caption, "of each label");
  EXPECT_EQ(WordsAt(bar, 0), "2 %");
  EXPECT_EQ(WordsAt(bar, 1), "98 %");
}

} // namespace
} // namespace voxelcore::testing
