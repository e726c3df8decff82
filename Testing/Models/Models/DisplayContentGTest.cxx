#include "Models/Models/ModelFixtures.h"

#include "voxelcore/Models/ColorRange.h"
#include "voxelcore/Models/DisplayContent.h"

#include <gtest/gtest.h>

namespace voxelcore::testing
{
namespace
{

DisplayLabel
WithMedial(const MedialComplex & core)
{
  DisplayLabel label;
  label.medial.core = core;
  return label;
}

TEST(DisplayContent, WhatIsNotToBeShownIsEmptyAndHasNoValues)
{
  const DisplayLabel nothing;
  for (const auto coloring :
       { PictureColoring::Radius, PictureColoring::Lambda, PictureColoring::ErosionThickness, PictureColoring::Label })
  {
    EXPECT_TRUE(ShownValues(nothing, coloring).empty());
    EXPECT_TRUE(RangeOfLabels({ &nothing, 1 }, coloring).IsEmpty());
  }
  // A surface has no values: it is drawn in the label's colour.
  DisplayLabel surface;
  surface.surface = { { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }, { { 0, 1, 2 } } };
  EXPECT_TRUE(ShownValues(surface, PictureColoring::Radius).empty());
  // Where the erosion thickness is not known there is none to be shown.
  const DisplayLabel medial = WithMedial(MixedModel().parts[0].core);
  EXPECT_FALSE(ShownValues(medial, PictureColoring::Radius).empty());
  EXPECT_FALSE(ShownValues(medial, PictureColoring::Lambda).empty());
  EXPECT_TRUE(ShownValues(medial, PictureColoring::ErosionThickness).empty());
  EXPECT_TRUE(ShownValues(medial, PictureColoring::Label).empty());
}

TEST(DisplayContent, OneRangeServesAllLabelsAndThoseWithNothingTakeNoPart)
{
  DisplayContent content;
  for (const double radius : { 2.0, 8.0 })
  {
    MedialComplex core = MakeCore(4, {}, { { 0, 1, 2, 3 } });
    core.positions = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } };
    core.radius.assign(4, radius);
    content.labels.push_back(WithMedial(core));
    content.labels.emplace_back(); // nothing of this one is shown
  }
  const ColorRange together = RangeOfLabels(content.labels, PictureColoring::Radius);
  EXPECT_EQ(together.low, 2);
  EXPECT_EQ(together.high, 8);
  const ColorRange first = RangeOfLabels({ content.labels.data(), 2 }, PictureColoring::Radius);
  EXPECT_EQ(first.least, 2);
  EXPECT_EQ(first.greatest, 2);
  EXPECT_TRUE(RangeOfLabels({ content.labels.data() + 3, 1 }, PictureColoring::Radius).IsEmpty());
}

} // namespace
} // namespace voxelcore::testing
