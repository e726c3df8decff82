#include "SheetBuilder.h"
#include "VoxelCoreTesting/Random.h"
#include "VoxelCoreTesting/Shapes.h"

#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Sheets/MedialSheets.h"
#include "voxelcore/VoxelCore/VoxelCore.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace voxelcore::testing
{
namespace
{

/** Three plates about a line along z. */
SheetBuilder
ThreePlates()
{
  SheetBuilder y;
  y.Plate({ 0, 0, 0 }, { 1, 0, 0 }, 10, { 0, 0, 1 }, 12);
  y.Plate({ 0, 0, 0 }, { -0.5, 0.866, 0 }, 8, { 0, 0, 1 }, 12);
  y.Plate({ 0, 0, 0 }, { -0.5, -0.866, 0 }, 6, { 0, 0, 1 }, 12);
  return y;
}

TEST(MedialSheets, OfAPlateAreOne)
{
  SheetBuilder plate;
  plate.Plate({ 0, 0, 0 }, { 1, 0, 0 }, 7, { 0, 1, 0 }, 5);
  const MedialSheets cut = CutIntoSheets(plate.Core(), 3);
  EXPECT_EQ(CountsOf(cut), (SheetCounts{ 1, 0, 0, 0 }));
  const SheetRecord & sheet = cut.sheets[0];
  EXPECT_DOUBLE_EQ(sheet.area, 35);
  EXPECT_DOUBLE_EQ(sheet.thickness, 2);
  EXPECT_NEAR(sheet.thicknessDeviation, 0, 1e-7);
  EXPECT_NEAR(sheet.normal[2], 1, 1e-12);
  EXPECT_NEAR(sheet.flatness, 1, 1e-12);
  EXPECT_DOUBLE_EQ(sheet.freeBorder, 24);
  EXPECT_DOUBLE_EQ(sheet.seamBorder, 0);
  EXPECT_TRUE(sheet.neighbours.empty());
}

TEST(MedialSheets, ThatMeetInALineHaveASeamThatEndsFreely)
{
  const MedialSheets cut = CutIntoSheets(ThreePlates().Core(), 3);
  EXPECT_EQ(CountsOf(cut), (SheetCounts{ 3, 1, 0, 0 }));
  EXPECT_NEAR(cut.sheets[0].area, 120, 1e-9);
  EXPECT_NEAR(cut.sheets[2].area, 72, 0.01);
  EXPECT_DOUBLE_EQ(cut.curves[0].length, 12);
  EXPECT_EQ(cut.curves[0].sheets, (std::vector<std::uint32_t>{ 0, 1, 2 }));
  EXPECT_EQ(cut.curves[0].vertices.size(), 13U);
  EXPECT_EQ(cut.curves[0].junctions, (std::array{ kNoPiece, kNoPiece }));
  EXPECT_FALSE(cut.curves[0].isClosed);
  EXPECT_EQ(cut.sheets[1].neighbours, (std::vector<std::uint32_t>{ 0, 2 }));
  EXPECT_DOUBLE_EQ(cut.sheets[1].seamBorder, 12);
}

TEST(MedialSheets, ASeamThatEndsJustBeforeTheRimIsDrawnOnToIt)
{
  // The third plate ends two squares before the rim, round which the other two hang together.
  SheetBuilder y;
  y.Plate({ 0, 0, 0 }, { 1, 0, 0 }, 10, { 0, 0, 1 }, 14);
  y.Plate({ 0, 0, 0 }, { -0.5, 0.866, 0 }, 8, { 0, 0, 1 }, 14);
  y.Plate({ 0, 0, 0 }, { -0.5, -0.866, 0 }, 7, { 0, 0, 1 }, 12);
  EXPECT_EQ(CountsOf(CutIntoSheets(y.Core(), 3)), (SheetCounts{ 3, 1, 0, 0 }));
  EXPECT_EQ(CountsOf(CutIntoSheets(y.Core(), 0.5)), (SheetCounts{ 2, 1, 0, 0 })) << "two and no radius more";
}

TEST(MedialSheets, ASeamThatEndsIsDrawnOnAlongTheFootOfAFinHoweverLong)
{
  SheetBuilder y;
  y.Plate({ 0, 0, 0 }, { 1, 0, 0 }, 10, { 0, 0, 1 }, 24);
  y.Plate({ 0, 0, 0 }, { -0.5, 0.866, 0 }, 8, { 0, 0, 1 }, 24);
  y.Plate({ 0, 0, 0 }, { -0.5, -0.866, 0 }, 7, { 0, 0, 1 }, 12);
  EXPECT_EQ(CountsOf(CutIntoSheets(y.Core(), 3)), (SheetCounts{ 2, 1, 0, 0 })) << "twelve to the rim";
  y.Plate({ 0, 0, 13 }, { -0.5, -0.866, 0 }, 2, { 0, 0, 1 }, 9);
  EXPECT_EQ(CountsOf(CutIntoSheets(y.Core(), 3)), (SheetCounts{ 3, 1, 0, 0 })) << "one to the fin, two to the rim";
}

TEST(MedialSheets, ASeamWithAGapIsOne)
{
  SheetBuilder y;
  y.Plate({ 0, 0, 0 }, { 1, 0, 0 }, 10, { 0, 0, 1 }, 22);
  y.Plate({ 0, 0, 0 }, { -0.5, 0.866, 0 }, 8, { 0, 0, 1 }, 22);
  y.Plate({ 0, 0, 0 }, { -0.5, -0.866, 0 }, 7, { 0, 0, 1 }, 10);
  y.Plate({ 0, 0, 12 }, { -0.5, -0.866, 0 }, 7, { 0, 0, 1 }, 10);
  const MedialSheets cut = CutIntoSheets(y.Core(), 3);
  // The third wall is two sheets, as there is a slit in it.
  EXPECT_EQ(cut.sheets.size(), 4U);
  EXPECT_EQ(CountsOf(cut).junctions, 1U);
}

TEST(MedialSheets, AFinThatHardlyStandsOutIsPassedOver)
{
  SheetBuilder plate;
  plate.Plate({ 0, 0, 0 }, { 1, 0, 0 }, 12, { 0, 1, 0 }, 10);
  plate.Plate({ 6, 0, 0 }, { 0, 0, 1 }, 2, { 0, 1, 0 }, 10);
  const MedialSheets cut = CutIntoSheets(plate.Core(), 3);
  EXPECT_EQ(CountsOf(cut), (SheetCounts{ 1, 0, 0, 0 }));
  EXPECT_DOUBLE_EQ(cut.sheets[0].area, 140) << "the fin is part of the sheet it hangs on";
  EXPECT_EQ(CountsOf(CutIntoSheets(plate.Core(), 1)), (SheetCounts{ 3, 1, 0, 0 }));
}

TEST(MedialSheets, ARibThatFinsCutUpIsWhole)
{
  SheetBuilder plate;
  plate.Plate({ 0, 0, 0 }, { 1, 0, 0 }, 12, { 0, 1, 0 }, 12);
  plate.Plate({ 6, 0, 0 }, { 0, 0, 1 }, 8, { 0, 1, 0 }, 12);
  for (int at = 2; at < 8; at += 2) // small fins on the rib
  {
    plate.Plate({ 6, 0, static_cast<double>(at) }, { 1, 0, 0 }, 1, { 0, 1, 0 }, 12);
  }
  EXPECT_EQ(CountsOf(CutIntoSheets(plate.Core(), 3)), (SheetCounts{ 3, 1, 0, 0 }));
}

TEST(MedialSheets, ANarrowStripBetweenSeamsJoinsTheSheetItContinues)
{
  // Two plates that bend up by 60 degrees from the ends of a strip, and the strip's own plane goes on to the left.
  SheetBuilder x;
  x.Plate({ 0, 0, 0 }, { 1, 0, 0 }, 2, { 0, 1, 0 }, 12);   // the strip
  x.Plate({ 0, 0, 0 }, { -1, 0, 0 }, 10, { 0, 1, 0 }, 12); // goes on
  x.Plate({ 0, 0, 0 }, { -0.5, 0, 0.866 }, 7, { 0, 1, 0 }, 12);
  x.Plate({ 2, 0, 0 }, { 0.5, 0, 0.866 }, 8, { 0, 1, 0 }, 12);
  x.Plate({ 2, 0, 0 }, { 0.5, 0, -0.866 }, 9, { 0, 1, 0 }, 12);
  const MedialSheets cut = CutIntoSheets(x.Core(), 3);
  EXPECT_EQ(CountsOf(cut), (SheetCounts{ 4, 1, 0, 0 })) << "both its sides are one seam";
  EXPECT_NEAR(cut.sheets[0].area, 144, 1e-9) << "ten and two wide";
  EXPECT_EQ(cut.curves[0].sheets, (std::vector<std::uint32_t>{ 0, 1, 2, 3 }));
  EXPECT_DOUBLE_EQ(cut.curves[0].length, 12);
}

TEST(MedialSheets, AStripIsOneTooIfItStandsOutByLessThanTheRadiusAtItsSeams)
{
  const auto counts = [](double radius) {
    SheetBuilder x;
    x.Plate({ 0, 0, 0 }, { 1, 0, 0 }, 4, { 0, 1, 0 }, 24, radius);
    x.Plate({ 0, 0, 0 }, { -0.6, 0, 0.8 }, 17, { 0, 1, 0 }, 24, radius);
    x.Plate({ 0, 0, 0 }, { -0.6, 0, -0.8 }, 18, { 0, 1, 0 }, 24, radius);
    x.Plate({ 4, 0, 0 }, { 0.6, 0, 0.8 }, 19, { 0, 1, 0 }, 24, radius);
    x.Plate({ 4, 0, 0 }, { 0.6, 0, -0.8 }, 20, { 0, 1, 0 }, 24, radius);
    return CountsOf(CutIntoSheets(x.Core(), 1));
  };
  EXPECT_EQ(counts(1.5), (SheetCounts{ 5, 2, 0, 0 })) << "by two";
  EXPECT_EQ(counts(2.5), (SheetCounts{ 4, 1, 0, 0 }));
}

TEST(MedialSheets, WhereTheSeamOrTheStripOfACrossingEndsBeforeTheRimFourSheetsMeetStill)
{
  // Beyond its end, at y = 10, the two upper walls are one bent sheet, and the two lower ones.
  for (const double width : { 0.0, 2.0 })
  {
    SheetBuilder x;
    const auto   wall = [&](const Vector3 & out, double side, double height) {
      const auto at = [&](int y, int k) {
        const Vector3 foot{ y < 10 ? side : width / 2, static_cast<double>(y), y > 10 ? height : 0 };
        return x.At(AddScaled(foot, k, out));
      };
      for (int y = 0; y < 12; ++y)
      {
        for (int k = 0; k < 7; ++k)
        {
          x.Face({ at(y, k), at(y, k + 1), at(y + 1, k + 1), at(y + 1, k) });
        }
      }
    };
    wall({ -0.6, 0, 0.8 }, 0, 0.3);
    wall({ 0.6, 0, 0.8 }, width, 0.3);
    wall({ -0.6, 0, -0.8 }, 0, -0.3);
    wall({ 0.6, 0, -0.8 }, width, -0.3);
    if (width > 0)
    {
      x.Plate({ 0, 0, 0 }, { 2, 0, 0 }, 1, { 0, 1, 0 }, 9);
      x.Face({ x.At({ 0, 9, 0 }), x.At({ 2, 9, 0 }), x.At({ 1, 10, 0 }) });
    }
    EXPECT_EQ(CountsOf(CutIntoSheets(x.Core(), 3)), (SheetCounts{ 4, 1, 0, 0 })) << width;
  }
}

TEST(MedialSheets, ASeamThatIsShorterThanItsBallsAreWideIsAJunction)
{
  const auto counts = [](double radius) {
    SheetBuilder two;
    // A wall; on one side of it one more up to z = 12, on the other side one from z = 8.
    two.Plate({ -12, 0, 0 }, { 1, 0, 0 }, 12, { 0, 0, 1 }, 20, radius);
    two.Plate({ 0, 0, 0 }, { 1, 0, 0 }, 12, { 0, 0, 1 }, 20, radius);
    two.Plate({ 0, 0, 0 }, { 0, 1, 0 }, 12, { 0, 0, 1 }, 12, radius);
    two.Plate({ 0, 0, 8 }, { 0, -1, 0 }, 12, { 0, 0, 1 }, 12, radius);
    return CountsOf(CutIntoSheets(two.Core(), 1));
  };
  EXPECT_EQ(counts(0.5), (SheetCounts{ 4, 3, 0, 2 })) << "the middle seam, of four walls, is four long";
  EXPECT_EQ(counts(2.5), (SheetCounts{ 4, 2, 0, 1 })) << "balls are five wide";
}

TEST(MedialSheets, OfATripleOfPlatesOnAPlateMeetInAJunction)
{
  // A floor, and the three plates that stand on it: a Y in the floor.
  SheetBuilder y = ThreePlates();
  const double reach = 14;
  // A fan of triangles about the foot of the line; the feet of the plates are edges of it.
  const auto ring = [&](const Vector3 & along, int n, const Vector3 & next, int m) {
    const ElementIndex middle = y.At({ 0, 0, 0 });
    const ElementIndex a = y.At(AddScaled({ 0, 0, 0 }, reach, along));
    const ElementIndex b = y.At(AddScaled({ 0, 0, 0 }, reach, next));
    // From the far end of one plate's foot to that of the next, seen from the middle.
    std::vector<ElementIndex> rim{ middle };
    for (int i = 1; i <= n; ++i)
    {
      rim.push_back(y.At(AddScaled({ 0, 0, 0 }, i, along)));
    }
    rim.push_back(a);
    rim.push_back(b);
    for (int i = m; i >= 1; --i)
    {
      rim.push_back(y.At(AddScaled({ 0, 0, 0 }, i, next)));
    }
    y.Face(rim);
  };
  ring({ 1, 0, 0 }, 10, { -0.5, 0.866, 0 }, 8);
  ring({ -0.5, 0.866, 0 }, 8, { -0.5, -0.866, 0 }, 6);
  ring({ -0.5, -0.866, 0 }, 6, { 1, 0, 0 }, 10);
  const MedialSheets cut = CutIntoSheets(y.Core(), 3);
  // The floor is one sheet, as its thirds meet beyond the ends of the plates' feet.
  EXPECT_EQ(CountsOf(cut), (SheetCounts{ 4, 4, 0, 1 }));
  for (const CurveRecord & curve : cut.curves)
  {
    EXPECT_EQ(std::count(curve.junctions.begin(), curve.junctions.end(), 0U), 1) << "one end in the junction";
  }
  // Each seam of the floor has the floor twice.
  std::size_t twice = 0;
  for (const CurveRecord & curve : cut.curves)
  {
    twice += std::set<std::uint32_t>(curve.sheets.begin(), curve.sheets.end()).size() == 2 ? 1 : 0;
  }
  EXPECT_EQ(twice, 3U);
}

TEST(MedialSheets, APocketInASheetMakesNoSeam)
{
  // A plate, of which four squares are doubled by a lid that stands out by less than a sliver.
  for (const double height : { 1.0, 9.0 })
  {
    SheetBuilder plate;
    plate.Plate({ 0, 0, 0 }, { 1, 0, 0 }, 8, { 0, 1, 0 }, 8);
    const ElementIndex top = plate.At({ 4, 4, height });
    const Vector3      ring[] = { { 3, 3, 0 }, { 4, 3, 0 }, { 5, 3, 0 }, { 5, 4, 0 },
                                  { 5, 5, 0 }, { 4, 5, 0 }, { 3, 5, 0 }, { 3, 4, 0 } };
    for (std::size_t i = 0; i < 8; ++i)
    {
      plate.Face({ plate.At(ring[i]), plate.At(ring[(i + 1) % 8]), top });
    }
    const MedialSheets cut = CutIntoSheets(plate.Core(), 3);
    EXPECT_EQ(CountsOf(cut).seams, height < 3 ? 0U : 1U);
    EXPECT_EQ(CountsOf(cut).sheets, height < 3 ? 1U : 2U);
  }
}

TEST(MedialSheets, AMoebiusBandIsOneSheetWithoutSeam)
{
  SheetBuilder band;
  const int    n = 40;
  const double turn = 2 * std::acos(-1.0);
  const auto   at = [&](int i, int j) {
    const double t = turn * i / n;
    const double w = j - 3.0;
    return Vector3{ (20 + w * std::cos(t / 2)) * std::cos(t),
                    (20 + w * std::cos(t / 2)) * std::sin(t),
                    w * std::sin(t / 2) };
  };
  for (int i = 0; i < n; ++i)
  {
    for (int j = 0; j < 6; ++j)
    {
      band.Face({ band.At(at(i, j)), band.At(at(i + 1, j)), band.At(at(i + 1, j + 1)), band.At(at(i, j + 1)) });
    }
  }
  EXPECT_EQ(CountsOf(CutIntoSheets(band.Core(), 3)), (SheetCounts{ 1, 0, 0, 0 }));
}

TEST(MedialSheets, AndRodsGetEveryVoxelOfRandomShapes)
{
  for (const RandomVolume & volume : RandomVolumes(8500, 60))
  {
    SCOPED_TRACE(volume.Describe());
    const SpacingWeights weights = ComputeSpacingWeights(volume.spacing);
    const MedialComplex  core = ComputeVoxelCore(volume.shape, weights);
    const MedialSheets   cut = CutIntoSheets(core, 2);
    for (const std::uint32_t piece : cut.sheetOfFace)
    {
      ASSERT_LT(piece, cut.sheets.size() + cut.curves.size());
      ASSERT_TRUE(piece < cut.sheets.size() || cut.curves[piece - cut.sheets.size()].isRod);
    }
    std::uint64_t voxels = 0;
    for (const std::uint32_t piece : PiecesOfVoxels(cut, OwnersAmong(BallsOfCore(core), volume.shape, weights)).values)
    {
      ASSERT_GT(piece, 0U);
      ASSERT_LE(piece, cut.sheets.size() + cut.curves.size());
      ASSERT_TRUE(piece <= cut.sheets.size() || cut.curves[piece - cut.sheets.size() - 1].isRod);
      ++voxels;
    }
    ASSERT_EQ(voxels, volume.shape.CountVoxels());
    double area = 0;
    for (std::size_t i = 0; i < cut.sheets.size(); ++i)
    {
      area += cut.sheets[i].area;
      ASSERT_TRUE(i == 0 || cut.sheets[i].area <= cut.sheets[i - 1].area * (1 + 1e-9));
    }
    ASSERT_TRUE(area > 0 || cut.sheets.empty());
  }
}

} // namespace
} // namespace voxelcore::testing
