#include "SheetBuilder.h"

#include "voxelcore/Sheets/MedialSheets.h"

#include <gtest/gtest.h>

namespace voxelcore::testing
{
namespace
{

TEST(SheetFins, AStripBetweenTwoPairsOfWallsIsNoneHoweverFreeItsBorder)
{
  // More than a quarter of its border is free.
  SheetBuilder x;
  x.Plate({ 0, 0, 0 }, { 1, 0, 0 }, 2, { 0, 1, 0 }, 5);
  x.Plate({ 0, 0, 0 }, { -0.6, 0, 0.8 }, 9, { 0, 1, 0 }, 5);
  x.Plate({ 0, 0, 0 }, { -0.6, 0, -0.8 }, 9, { 0, 1, 0 }, 5);
  x.Plate({ 2, 0, 0 }, { 0.6, 0, 0.8 }, 9, { 0, 1, 0 }, 5);
  x.Plate({ 2, 0, 0 }, { 0.6, 0, -0.8 }, 9, { 0, 1, 0 }, 5);
  EXPECT_EQ(CountsOf(CutIntoSheets(x.Core(), 3)), (SheetCounts{ 4, 1, 0, 0 }));
}

TEST(SheetFins, WhatHangsOnThemAloneIsPartOfTheSheetTheyHangOn)
{
  // Four squares of a fin are doubled by a lid: both are left, and nothing round them.
  SheetBuilder plate;
  plate.Plate({ -12, 0, 0 }, { 1, 0, 0 }, 24, { 0, 1, 0 }, 10);
  plate.Plate({ 0, 0, 0 }, { 0, 0, 1 }, 4, { 0, 1, 0 }, 10);
  const ElementIndex top = plate.At({ 0.5, 5, 2 });
  const Vector3      ring[] = { { 0, 4, 1 }, { 0, 5, 1 }, { 0, 6, 1 }, { 0, 6, 2 },
                                { 0, 6, 3 }, { 0, 5, 3 }, { 0, 4, 3 }, { 0, 4, 2 } };
  for (std::size_t i = 0; i < 8; ++i)
  {
    plate.Face({ plate.At(ring[i]), plate.At(ring[(i + 1) % 8]), top });
  }
  EXPECT_EQ(CountsOf(CutIntoSheets(plate.Core(), 5)), (SheetCounts{ 1, 0, 0, 0 }));
}

TEST(SheetFins, ThatComeOffWhereASeamIsDrawnOnLeaveOtherEndsOfSeamsAsTheyWere)
{
  // Four walls about a strip that ends in two prongs. Lines from their tips to the rim cut what goes round these into
  // pieces that hardly stand out. Far off, a fin hangs on a wall round the end of its seam, until that is drawn on.
  SheetBuilder x;
  x.Face({ x.At({ 1, 8, 0 }), x.At({ 0, 10, 0 }), x.At({ 0, 8, 0 }) });
  x.Face({ x.At({ 1, 8, 0 }), x.At({ 2, 10, 0 }), x.At({ 2, 8, 0 }) });
  x.Face({ x.At({ 0, 8, 0 }), x.At({ 0, 7, 0 }), x.At({ 2, 7, 0 }), x.At({ 2, 8, 0 }), x.At({ 1, 8, 0 }) });
  x.Plate({ 0, 0, 0 }, { 2, 0, 0 }, 1, { 0, 1, 0 }, 7);
  for (const double up : { 1.0, -1.0 })
  {
    const auto at = [&](double along, int y, const Vector3 & out = { 0, 0, 0 }) {
      return x.At(AddScaled({ along, 1.0 * y, y > 10 || along == 1 ? 0.1 * up : 0 }, 1, out));
    };
    const auto wall = [&](double foot, const Vector3 & out, int from, int to, int end) {
      const auto corner = [&](int y, int k) { return at(foot, y, AddScaled({ 0, 0, 0 }, k, out)); };
      for (int y = 0; y < end; ++y)
      {
        for (int k = from; k < to; ++k)
        {
          const bool isSplit = y == 8 && k == 0; // the prong is one edge there
          isSplit ? x.Face({ corner(8, 0), corner(8, 1), corner(9, 1), corner(10, 1), corner(10, 0) }) : void();
          k > 0 || (y != 8 && y != 9)
            ? x.Face({ corner(y, k), corner(y, k + 1), corner(y + 1, k + 1), corner(y + 1, k) })
            : void();
        }
      }
    };
    wall(0, { -0.6, 0, 0.8 * up }, 0, 9, 12);
    wall(2, { 0.6, 0, 0.8 * up }, 0, 9, 12);
    for (const double foot : { 0.0, 2.0 })
    {
      x.Face({ x.At({ 1, 8, 0 }), at(foot, 10), at(1, 10) });
      for (int y = 10; y < 12; ++y)
      {
        x.Face({ at(foot, y), at(foot, y + 1), at(1, y + 1), at(1, y) });
      }
    }
    if (up > 0)
    {
      wall(2, { 0.6, 0, 0.8 }, 9, 16, 10);
      for (int y = 0; y < 12; ++y)
      {
        const Vector3 foot{ 5.4, 0, 7.2 };
        const Vector3 tip{ 6.2, 0, 6.6 };
        x.Face({ at(2, y, foot), at(2, y + 1, foot), at(2, y + 1, tip), at(2, y, tip) });
      }
    }
  }
  EXPECT_EQ(CountsOf(CutIntoSheets(x.Core(), 2)), (SheetCounts{ 4, 1, 0, 0 }));
}

} // namespace
} // namespace voxelcore::testing
