// Rods and flakes of medial surfaces that are cut into sheets.

#include "SheetBuilder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace voxelcore::testing
{
namespace
{

TEST(MedialSheets, RodsAreCutWhereTheyMeetAndWhereTheyReachASheet)
{
  SheetBuilder rods;
  rods.Plate({ 0, 0, 0 }, { 1, 0, 0 }, 6, { 0, 1, 0 }, 6);
  rods.Rod({ 3, 3, 0 }, { 0, 0, 1 }, 10);
  rods.Rod({ 3, 3, 10 }, { 0.7, 0, 0.7 }, 5);
  rods.Rod({ 3, 3, 10 }, { -0.7, 0, 0.7 }, 4);
  const MedialSheets cut = CutIntoSheets(rods.Core(), 3);
  EXPECT_EQ(CountsOf(cut), (SheetCounts{ 1, 0, 3, 2 }));
  EXPECT_DOUBLE_EQ(cut.curves[0].length, 10);
  EXPECT_NE(cut.curves[0].junctions[0], kNoPiece);
  EXPECT_NE(cut.curves[0].junctions[1], kNoPiece);
  EXPECT_TRUE((cut.curves[1].junctions[0] == kNoPiece) != (cut.curves[1].junctions[1] == kNoPiece));
  EXPECT_TRUE(cut.curves[0].sheets.empty());
  // The rod's foot is the sheet's.
  EXPECT_EQ(cut.pieceOfVertex[cut.junctions[0]] < 1 || cut.pieceOfVertex[cut.junctions[1]] < 1, true);
}

TEST(MedialSheets, ARodThatHardlyStandsOutOfASheetIsPartOfIt)
{
  SheetBuilder rods;
  rods.Plate({ 0, 0, 0 }, { 1, 0, 0 }, 6, { 0, 1, 0 }, 6);
  rods.Rod({ 3, 3, 0 }, { 0, 0, 1 }, 2);
  const MedialSheets cut = CutIntoSheets(rods.Core(), 3);
  EXPECT_EQ(CountsOf(cut), (SheetCounts{ 1, 0, 0, 0 }));
  EXPECT_EQ(cut.pieceOfVertex, std::vector<std::uint32_t>(cut.pieceOfVertex.size(), 0U));
  EXPECT_EQ(CountsOf(CutIntoSheets(rods.Core(), 1)), (SheetCounts{ 1, 0, 1, 1 }));
  // Two twigs at its end change nothing.
  rods.Rod({ 3, 3, 2 }, { 0.7, 0, 0.7 }, 1);
  rods.Rod({ 3, 3, 2 }, { -0.7, 0, 0.7 }, 1);
  const MedialSheets twigs = CutIntoSheets(rods.Core(), 3);
  EXPECT_EQ(CountsOf(twigs), (SheetCounts{ 1, 0, 0, 0 }));
  EXPECT_EQ(twigs.pieceOfVertex, std::vector<std::uint32_t>(twigs.pieceOfVertex.size(), 0U));
}

TEST(MedialSheets, AHandleOfRodsThatHardlyStandsOutOfASheetIsPartOfItAndAHighOneIsNot)
{
  for (const int height : { 1, 6 })
  {
    SheetBuilder plate;
    plate.Plate({ 0, 0, 0 }, { 1, 0, 0 }, 6, { 0, 1, 0 }, 6);
    plate.Rod({ 1, 3, 0 }, { 0, 0, 1 }, height);
    plate.Rod({ 1, 3, static_cast<double>(height) }, { 1, 0, 0 }, 3);
    plate.Rod({ 4, 3, 0 }, { 0, 0, 1 }, height);
    const MedialSheets cut = CutIntoSheets(plate.Core(), 3);
    // From a foot to the middle of the handle it is two and a half long, or seven and a half.
    EXPECT_EQ(CountsOf(cut), height == 1 ? (SheetCounts{ 1, 0, 0, 0 }) : (SheetCounts{ 1, 0, 1, 2 }));
    if (height == 1)
    {
      EXPECT_EQ(cut.pieceOfVertex, std::vector<std::uint32_t>(cut.pieceOfVertex.size(), 0U));
    }
  }
}

TEST(MedialSheets, ARodBetweenTwoSheetsIsOneWhereItIsLongerThanThickAndThanASliver)
{
  for (const double length : { 2.0, 3.5, 8.0 })
  {
    for (const double radius : { 0.5, 2.0 })
    {
      SheetBuilder plates;
      plates.At({ 3, 3, 0 }, radius);
      plates.At({ 3, 3, length / 2 }, radius);
      plates.At({ 3, 3, length }, radius);
      plates.Plate({ 0, 0, 0 }, { 1, 0, 0 }, 6, { 0, 1, 0 }, 6);
      plates.Plate({ 0, 0, length }, { 1, 0, 0 }, 6, { 0, 1, 0 }, 6);
      plates.Rod({ 3, 3, 0 }, { 0, 0, length / 2 }, 2);
      const bool isRod = length > 3 && length > 2 * radius;
      EXPECT_EQ(CountsOf(CutIntoSheets(plates.Core(), 3)),
                isRod ? (SheetCounts{ 2, 0, 1, 2 }) : (SheetCounts{ 2, 0, 0, 0 }))
        << length << " long, radius " << radius;
    }
  }
}

TEST(MedialSheets, ASmallFlakeThatHangsByARodOrAPointIsPartOfItsSheet)
{
  for (const int size : { 1, 7 })
  {
    for (const double gap : { 0.0, 0.5 })
    {
      SheetBuilder plates;
      plates.Plate({ 0, 0, 0 }, { 1, 0, 0 }, 9, { 0, 1, 0 }, 9);
      plates.Plate({ 9 + gap, 9, 0 }, { 1, 0, 0 }, size, { 0, 1, 0 }, size);
      if (gap > 0)
      {
        plates.Rod({ 9, 9, 0 }, { gap, 0, 0 }, 1);
      }
      const MedialSheets cut = CutIntoSheets(plates.Core(), 3);
      EXPECT_EQ(CountsOf(cut), (SheetCounts{ size == 1 ? 1U : 2U, 0, 0, 0 })) << size << " wide, " << gap << " off";
    }
  }
  // Alone it stays.
  SheetBuilder alone;
  alone.Plate({ 0, 0, 0 }, { 1, 0, 0 }, 9, { 0, 1, 0 }, 9);
  alone.Plate({ 20, 0, 0 }, { 1, 0, 0 }, 1, { 0, 1, 0 }, 1);
  EXPECT_EQ(CountsOf(CutIntoSheets(alone.Core(), 3)), (SheetCounts{ 2, 0, 0, 0 }));
}

TEST(MedialSheets, AFlakeAtTheTipOfARodIsPartOfTheSheetIfTheRodIs)
{
  for (const double radius : { 1.0, 3.0 })
  {
    SheetBuilder plate;
    plate.Plate({ 0, 0, 0 }, { 1, 0, 0 }, 15, { 0, 1, 0 }, 15, 3);
    plate.Rod({ 15, 15, 0 }, { 1, 0, 0 }, 4, radius);
    plate.Plate({ 19, 15, 0 }, { 1, 0, 0 }, 1, { 0, 1, 0 }, 1, 1);
    EXPECT_EQ(CutIntoSheets(plate.Core(), 0.5).sheets.size(), radius < 3 ? 2U : 1U) << "stands out by four";
  }
}

TEST(MedialSheets, AFlakeWhereRodsMeetIsTheirJunctionAndALargeOneIsASheet)
{
  const auto cutOf = [](int side) {
    SheetBuilder rods;
    rods.Plate({ 0, 0, 0 }, { 1, 0, 0 }, side, { 0, 1, 0 }, side);
    rods.Rod({ 0, 0, 0 }, { -1, 0, 0 }, 10);
    rods.Rod({ 0, 0, 0 }, { 0, -1, 0 }, 11);
    rods.Rod({ 1.0 * side, 1.0 * side, 0 }, { 0, 0, 1 }, 12);
    return CutIntoSheets(rods.Core(), 3);
  };
  const MedialSheets small = cutOf(2);
  EXPECT_EQ(CountsOf(small), (SheetCounts{ 0, 0, 3, 1 }));
  EXPECT_TRUE(
    std::all_of(small.sheetOfFace.begin(), small.sheetOfFace.end(), [](std::uint32_t piece) { return piece < 3; }))
    << "part of a rod";
  EXPECT_EQ(CountsOf(cutOf(9)), (SheetCounts{ 1, 0, 3, 2 }));
}

TEST(MedialSheets, TwoFlakesThatAShortRodJoinsAreOneJunction)
{
  SheetBuilder rods;
  rods.Plate({ 0, 0, 0 }, { 1, 0, 0 }, 2, { 0, 1, 0 }, 2);
  rods.Rod({ 0, 0, 0 }, { -1, 0, 0 }, 10);
  rods.Rod({ 0, 0, 0 }, { 0, -1, 0 }, 11);
  rods.Rod({ 2, 2, 0 }, { 0, 0, 1 }, 1);
  rods.Plate({ 2, 2, 1 }, { 1, 0, 0 }, 1, { 0, 1, 0 }, 1);
  rods.Rod({ 3, 3, 1 }, { 0, 0, 1 }, 12);
  EXPECT_EQ(CountsOf(CutIntoSheets(rods.Core(), 4.5)), (SheetCounts{ 0, 0, 3, 1 }));
}

TEST(MedialSheets, ARodBetweenJunctionsThatIsShorterThanThickIsAJunction)
{
  const auto counts = [](int middle) {
    SheetBuilder rods;
    rods.Rod({ 0, 0, 0 }, { 1, 0, 0 }, middle);
    rods.Rod({ 0, 0, 0 }, { -0.7, 0.7, 0 }, 10);
    rods.Rod({ 0, 0, 0 }, { -0.7, -0.7, 0 }, 10);
    rods.Rod({ 1.0 * middle, 0, 0 }, { 0.7, 0, 0.7 }, 10);
    rods.Rod({ 1.0 * middle, 0, 0 }, { 0.7, 0, -0.7 }, 10);
    return CountsOf(CutIntoSheets(rods.Core(), 0.5));
  };
  EXPECT_EQ(counts(1), (SheetCounts{ 0, 0, 4, 1 })) << "balls are two wide";
  EXPECT_EQ(counts(3), (SheetCounts{ 0, 0, 5, 2 }));
}

TEST(MedialSheets, ShortRodsThatMeetAloneDoNotGoAltogether)
{
  SheetBuilder y;
  y.Rod({ 0, 0, 0 }, { 1, 0, 0 }, 2);
  y.Rod({ 0, 0, 0 }, { -0.5, 0.8, 0 }, 2);
  y.Rod({ 0, 0, 0 }, { -0.5, -0.8, 0 }, 2);
  const MedialSheets cut = CutIntoSheets(y.Core(), 3);
  EXPECT_EQ(CountsOf(cut), (SheetCounts{ 0, 0, 1, 0 }));
  EXPECT_EQ(cut.pieceOfVertex, std::vector<std::uint32_t>(7, 0U));
}

TEST(MedialSheets, AClosedRodAndALonePointAreRods)
{
  SheetBuilder ring;
  for (int i = 0; i < 12; ++i)
  {
    const auto at = [](int k) {
      return Vector3{ 5 * std::cos(k * std::acos(-1.0) / 6), 5 * std::sin(k * std::acos(-1.0) / 6), 0 };
    };
    ring.Edge(ring.At(at(i)), ring.At(at((i + 1) % 12)));
  }
  ring.At({ 40, 0, 0 });
  const MedialSheets cut = CutIntoSheets(ring.Core(), 3);
  EXPECT_EQ(CountsOf(cut), (SheetCounts{ 0, 0, 2, 0 }));
  EXPECT_TRUE(cut.curves[0].isClosed);
  EXPECT_EQ(cut.curves[0].vertices.size(), 12U);
  EXPECT_EQ(cut.curves[1].length, 0);
  EXPECT_EQ(cut.pieceOfVertex[12], 1U);
}

} // namespace
} // namespace voxelcore::testing
