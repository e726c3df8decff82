// What a colour map runs over, and what is said of it.

#include "ColorBar.h"
#include "voxelcore/ColorRange.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace voxelcore::testing
{
namespace
{

/** A strip of squares one mm wide, side by side along x; radii as given at its left side, one more at the end. */
DisplayLabel
Strip(const std::vector<double> & radius)
{
  DisplayLabel    label;
  MedialComplex & core = label.medial.core;
  for (std::size_t i = 0; i < radius.size(); ++i)
  {
    for (const double y : { 0.0, 1.0 })
    {
      core.positions.push_back({ static_cast<double>(i), y, 0 });
      core.radius.push_back(radius[i]);
    }
  }
  core.cells.vertexCount = core.positions.size();
  for (ElementIndex i = 0; i + 1 < radius.size(); ++i)
  {
    for (const ElementIndex corner : { 2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1 })
    {
      core.cells.faceVertices.push_back(corner);
      core.cells.faceEdges.push_back(0);
    }
    core.cells.faceOffsets.push_back(core.cells.faceVertices.size());
  }
  core.cells.edges.push_back({ 0, 1 });
  return label;
}

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

TEST(ColorRange, LeavesOutTwoPerCentOfTheWeightAtEachEnd)
{
  std::mt19937               random(20261122);
  std::vector<WeightedValue> values;
  for (int i = 1; i <= 1000; ++i)
  {
    values.push_back({ static_cast<double>(i), 1 });
  }
  std::shuffle(values.begin(), values.end(), random);
  const ColorRange range = RangeOfShares(values);
  EXPECT_EQ(range.low, 21);
  EXPECT_EQ(range.high, 980);
  EXPECT_EQ(range.least, 1);
  EXPECT_EQ(range.greatest, 1000);
  const ColorRange all = RangeOfShares(values, { 0, 1 });
  EXPECT_EQ(all.low, 1);
  EXPECT_EQ(all.high, 1000);
}

TEST(ColorRange, GoesByAreaNotByNumber)
{
  // A million specks of radius 9 weigh less than one large part.
  std::vector<WeightedValue> values(1000000, { 9, 1e-9 });
  values.push_back({ 1, 50 });
  values.push_back({ 2, 50 });
  const ColorRange range = RangeOfShares(values);
  EXPECT_EQ(range.low, 1);
  EXPECT_EQ(range.high, 2);
  EXPECT_EQ(range.greatest, 9);
  // A strip of squares, then the same with a hundred vertices that no face has.
  DisplayLabel label = Strip({ 1, 2, 3, 4, 5 });
  label.medial.core.positions.resize(110, { 0, 0, 0 });
  label.medial.core.radius.resize(110, 77);
  label.medial.core.cells.vertexCount = 110;
  label.medial.core.cells.edges[0] = { 100, 101 }; // of no length
  const ColorRange strip = RangeOfLabels({ &label, 1 }, PictureColoring::Radius);
  EXPECT_EQ(strip.low, 1);
  EXPECT_EQ(strip.high, 5);
}

TEST(ColorRange, LinesWeighAsMuchAsTheyAreLongAndThick)
{
  DisplayLabel    label;
  SkeletonGraph & graph = label.curves;
  graph.positions = { { 0, 0, 0 }, { 99, 0, 0 }, { 99, 0, 0 }, { 100, 0, 0 } };
  graph.radius = { 2, 2, 8, 8 };
  SortBranches(graph, { { 0, 1 }, { 2, 3 } }, false);
  const auto values = ShownValues(label, PictureColoring::Radius);
  double     thin = 0;
  double     thick = 0;
  for (const WeightedValue & v : values)
  {
    (v.value == 2 ? thin : thick) += v.weight;
  }
  EXPECT_DOUBLE_EQ(thin, 99 * 2);
  EXPECT_DOUBLE_EQ(thick, 1 * 8);
}

TEST(ColorRange, IsAllThereIsWhereThatIsOneValueOrNearlySo)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(RangeOfShares({}).IsEmpty());
  EXPECT_TRUE(RangeOfShares({ { infinity, 1 }, { std::nan(""), 1 } }).IsEmpty());
  const ColorRange one = RangeOfShares({ { 3, 1 }, { infinity, 5 }, { 3, 0 } });
  EXPECT_EQ(one.low, 3);
  EXPECT_EQ(one.high, 3);
  const ColorRange nearly = RangeOfShares({ { 3, 1000 }, { 4, 1 } });
  EXPECT_EQ(nearly.low, 3);
  EXPECT_EQ(nearly.high, 4);
  const ColorRange weightless = RangeOfShares({ { 3, 0 }, { 4, 0 } });
  EXPECT_EQ(weightless.low, 3);
  EXPECT_EQ(weightless.high, 4);
}

TEST(ColorBar, SaysWhatLiesBeyondItsEndsAndWhy)
{
  const ColorBar bar = DescribeColorBar({}, { 1.234, 9.876, 0.5, 20 });
  EXPECT_EQ(bar.title, "Radius (mm)");
  EXPECT_EQ(bar.caption, "2 to 98 % of area");
  EXPECT_EQ(WordsAt(bar, 0), "≤ 1.23");
  EXPECT_EQ(WordsAt(bar, 1), "≥ 9.88");
  EXPECT_TRUE(bar.below);
  EXPECT_TRUE(bar.above);
  const ColorBar all = DescribeColorBar({}, { 1, 9, 1, 9 });
  EXPECT_EQ(all.caption, "");
  EXPECT_EQ(WordsAt(all, 0), "1.00");
  EXPECT_EQ(WordsAt(all, 1), "9.00");
  EXPECT_FALSE(all.below || all.above);
  PictureOptions options;
  options.range = { 0, 5 };
  const ColorBar own = DescribeColorBar(options, { 0, 5, 0.5, 20 });
  EXPECT_EQ(own.caption, "");
  EXPECT_EQ(WordsAt(own, 0), "0");
  EXPECT_EQ(WordsAt(own, 1), "≥ 5");
}

TEST(ColorBar, NamesAUnitThatSuitsTheRange)
{
  const ColorBar nanometres = DescribeColorBar({}, { 2e-6, 56.71e-6, 1e-6, 60e-6 });
  EXPECT_EQ(nanometres.title, "Radius (nm)");
  EXPECT_EQ(WordsAt(nanometres, 0), "≤ 2.00");
  EXPECT_EQ(WordsAt(nanometres, 1), "≥ 56.7");
  PictureOptions options;
  options.coloring = PictureColoring::ErosionThickness;
  const ColorBar micrometres = DescribeColorBar(options, { 0, 0.05, 0, 0.05 });
  EXPECT_EQ(micrometres.title, "Erosion thickness (µm)");
  EXPECT_EQ(WordsAt(micrometres, 0.4), "20");
}

TEST(ColorBar, OfEachLabelHasNoLengths)
{
  PictureOptions options;
  options.eachLabel = true;
  const ColorBar bar = DescribeColorBar(options, { 1, 9, 0, 20 });
  EXPECT_EQ(bar.title, "Radius");
  EXPECT_EQ(bar.caption, "of each label");
  EXPECT_EQ(WordsAt(bar, 0), "2 %");
  EXPECT_EQ(WordsAt(bar, 1), "98 %");
}

} // namespace
} // namespace voxelcore::testing
