#include "SheetBuilder.h"

#include "voxelcore/Sheets/MedialSheets.h"

#include <gtest/gtest.h>

#include <cmath>
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

TEST(SheetNecks, OnlyPartsThatStandOutOfTheBallsOfTheirSeamsArePartedFromOthersByANeck)
{
  // A wall between two seams: half as wide as `half` says, in its neck within the balls there.
  const auto sheets = [](double chamber) {
    SheetBuilder wall;
    const auto   half = [&](int x) { return x < 10 ? 20.0 : x < 14 ? 5.0 : chamber; };
    const auto   at = [&](int x, int y) { return wall.At({ 1.0 * x, half(x) * y / 8, 0 }, std::abs(y) == 8 ? 6 : 3); };
    const auto side = [&](int x, int y, double z) { return wall.At({ 1.0 * x, half(x) * y / 8, z }, z == 0 ? 6 : 3); };
    for (int x = 0; x < 22; ++x)
    {
      for (int y = -8; y < 8; ++y)
      {
        wall.Face({ at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1) });
      }
      for (const int y : { -8, 8 })
      {
        for (int z = -12; z < 12; ++z)
        {
          wall.Face({ side(x, y, z), side(x + 1, y, z), side(x + 1, y, z + 1), side(x, y, z + 1) });
        }
      }
    }
    return CutIntoSheets(wall.Core(), 1).sheets.size();
  };
  EXPECT_EQ(sheets(8), 5U) << "five beyond balls of radius six";
  EXPECT_EQ(sheets(12), 6U);
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

TEST(SheetNecks, ACornerThatHardlyAnySeamBordersIsNotParted)
{
  SheetBuilder y;
  y.Plate({ -10, 0, 0 }, { 1, 0, 0 }, 20, { 0, 1, 0 }, 16, 5);
  y.Plate({ -10, 0, 0 }, { 1, 0, 0 }, 20, { 0, -1, 0 }, 17, 5);
  y.Plate({ -10, 0, 0 }, { 1, 0, 0 }, 20, { 0, 0, 1 }, 18, 5);
  // Beside the seam's end, within its ball, a foot two wide.
  y.Plate({ 10, 0, 0 }, { 1, 0, 0 }, 2, { 0, 1, 0 }, 2, 5);
  y.Plate({ 12, 0, 0 }, { 1, 0, 0 }, 12, { 0, 1, 0 }, 12, 5);
  EXPECT_EQ(CountsOf(CutIntoSheets(y.Core(), 3)), (SheetCounts{ 3, 1, 0, 0 }));
}

} // namespace
} // namespace voxelcore::testing
