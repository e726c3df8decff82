#include "SheetBuilder.h"

#include "voxelcore/MedialSheets.h"

#include <gtest/gtest.h>

#include <vector>

namespace voxelcore::testing
{
namespace
{

TEST(SheetNecks, SheetsThatHangTogetherOnlyWithinTheBallsOfTheirSeamArePartedThere)
{
  // The third wall leaves a way of three round the end of its seam; the other two are bent there.
  const auto counts = [](double radius) {
    SheetBuilder y;
    y.Plate({ 0, 0, 0 }, { 1, 0, 0 }, 14, { 0, 0, 1 }, 20, radius);
    y.Plate({ 0, 0, 0 }, { -0.5, 0.866, 0 }, 12, { 0, 0, 1 }, 20, radius);
    y.Plate({ 0, 0, 0 }, { -0.5, -0.866, 0 }, 10, { 0, 0, 1 }, 17, radius);
    return CountsOf(CutIntoSheets(y.Core(), 0.5));
  };
  EXPECT_EQ(counts(1), (SheetCounts{ 2, 1, 0, 0 }));
  EXPECT_EQ(counts(2), (SheetCounts{ 3, 1, 0, 0 })) << "balls are wider than the way";
}

TEST(SheetNecks, AWallIsNoNeckWhereItsFacesAreLarge)
{
  // Between two seams; in the middle of its length two faces lead from seam to seam.
  SheetBuilder wall;
  for (const double side : { -6.0, 6.0 })
  {
    wall.Plate({ 0, side, 0 }, { 1, 0, 0 }, 24, { 0, 0, 1 }, 8, 2);
    wall.Plate({ 0, side, 0 }, { 1, 0, 0 }, 24, { 0, 0, -1 }, 8, 2);
    std::vector<ElementIndex> large;
    for (int y = 0; y <= 6; ++y)
    {
      large.push_back(wall.At({ 10, side * y / 6, 0 }, 2));
    }
    for (int x = 11; x < 14; ++x)
    {
      large.push_back(wall.At({ 1.0 * x, side, 0 }, 2));
    }
    for (int y = 6; y >= 0; --y)
    {
      large.push_back(wall.At({ 14, side * y / 6, 0 }, 2));
    }
    wall.Face(large);
  }
  wall.Plate({ 0, -6, 0 }, { 1, 0, 0 }, 10, { 0, 1, 0 }, 12, 2);
  wall.Plate({ 14, -6, 0 }, { 1, 0, 0 }, 10, { 0, 1, 0 }, 12, 2);
  EXPECT_EQ(CountsOf(CutIntoSheets(wall.Core(), 3)), (SheetCounts{ 5, 2, 0, 0 }));
}

} // namespace
} // namespace voxelcore::testing
