// What a colour map runs over.

#include "voxelcore/Models/ColorRange.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
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

TEST(ColorRange, IsOfEachLabelWhereMostWouldShowLittleOfOneForAll)
{
  const auto       need = [](std::vector<LabelRange> labels) { return NeedOwnRanges(labels, { 0, 8, 0, 8 }); };
  const LabelRange thin{ { 0, 1, 0, 1 }, 6 };
  const LabelRange wide{ { 0, 8, 0, 8 }, 5 };
  EXPECT_TRUE(need({ thin, wide }));
  EXPECT_FALSE(need({ thin, wide, wide }));
  EXPECT_FALSE(need({ { { 0, 2, 0, 2 }, 6 }, wide }));
  EXPECT_FALSE(need({ wide }));
  EXPECT_FALSE(need({}));
  EXPECT_FALSE(need({ LabelRange{} }));
  // One value everywhere is all there is.
  EXPECT_FALSE(NeedOwnRanges(std::vector<LabelRange>{ { { 3, 3, 3, 3 }, 6 } }, { 3, 3, 3, 3 }));
  const LabelRange measured = RangeOfLabel({ { 1, 2 }, { 5, 3 }, { HUGE_VAL, 7 } });
  EXPECT_EQ(measured.range.high, 5);
  EXPECT_EQ(measured.weight, 5);
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

TEST(ColorRange, EachColoringTakesItsOwnValues)
{
  DisplayLabel label = Strip({ 1, 2, 3 });
  label.medial.core.vertexLambda.assign(label.medial.core.positions.size(), 20);
  label.erosionThickness.assign(label.medial.core.positions.size(), 300);
  label.curves.positions = { { 0, 0, 0 }, { 1, 0, 0 } };
  label.curves.radius = { 5, 6 };
  label.curves.erosionThickness = { 700, 800 };
  SortBranches(label.curves, { { 0, 1 } }, false);
  EXPECT_EQ(&MedialValues(label, PictureColoring::Radius), &label.medial.core.radius);
  EXPECT_EQ(&MedialValues(label, PictureColoring::Lambda), &label.medial.core.vertexLambda);
  EXPECT_EQ(&MedialValues(label, PictureColoring::ErosionThickness), &label.erosionThickness);
  EXPECT_EQ(&CurveValues(label, PictureColoring::Radius), &label.curves.radius);
  EXPECT_EQ(&CurveValues(label, PictureColoring::ErosionThickness), &label.curves.erosionThickness);
  EXPECT_TRUE(CurveValues(label, PictureColoring::Lambda).empty()) << "curves have none";
  const auto ends = [&](PictureColoring coloring) {
    const ColorRange range = RangeOfLabels({ &label, 1 }, coloring, { 0, 1 });
    return std::pair(range.low, range.high);
  };
  EXPECT_EQ(ends(PictureColoring::Radius), std::pair(1.0, 6.0));
  EXPECT_EQ(ends(PictureColoring::Lambda), std::pair(20.0, 20.0));
  EXPECT_EQ(ends(PictureColoring::ErosionThickness), std::pair(300.0, 800.0));
}

TEST(ColorRange, SharesOfRandomWeightsAreThoseOfAPlainSum)
{
  constexpr unsigned seed = 20261122;
  std::cout << "seed " << seed << '\n';
  std::mt19937 random(seed);
  for (int round = 0; round < 200; ++round)
  {
    std::vector<WeightedValue> values(2 + random() % 40);
    double                     whole = 0;
    for (auto & v : values)
    {
      // Powers of two and whole numbers: sums are exact.
      v = { static_cast<double>(random() % 12), static_cast<double>(random() % 4) / 4 };
      whole += v.weight;
    }
    const ColorShares shares{ static_cast<double>(random() % 8) / 16, static_cast<double>(9 + random() % 8) / 16 };
    const ColorRange  range = RangeOfShares(values, shares);
    if (whole == 0 || range.low == range.high || (range.low == range.least && range.high == range.greatest))
    {
      continue;
    }
    const auto below = [&](double end) {
      double sum = 0;
      for (const auto & v : values)
      {
        sum += v.value < end ? v.weight : 0;
      }
      return sum;
    };
    // No more than the share lies below the low end, and no more than the rest above the high one.
    ASSERT_LE(below(range.low), shares.low * whole) << "round " << round;
    ASSERT_GE(below(std::nextafter(range.high, HUGE_VAL)), shares.high * whole) << "round " << round;
    ASSERT_LE(range.least, range.low);
    ASSERT_LT(range.low, range.high);
    ASSERT_LE(range.high, range.greatest);
  }
}

} // namespace
} // namespace voxelcore::testing
