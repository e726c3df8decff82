#include "FloodFill.h"

#include "voxelcore/Shape/ShapeTopology.h"

namespace voxelcore::testing
{
namespace
{

TEST(ShapeOperations, NothingStaysNothing)
{
  for (const VoxelShape & nothing : { VoxelShape(), VoxelShape(VoxelBox{ { 4, 5, 6 }, { 70, 2, 3 } }) })
  {
    for (const EditedShape & edited : { CropToBox(nothing, { { 0, 0, 0 }, { 9, 9, 9 } }),
                                        RemoveSmallComponents(nothing, 5),
                                        KeepLargestComponents(nothing, 3),
                                        FillCavities(nothing) })
    {
      ExpectChange(edited, 0, 0, 0, 0, 0);
      ExpectTight(edited.shape, {});
    }
    EXPECT_TRUE(SplitComponents(nothing).empty());
  }
}

TEST(ShapeOperations, CropKeepsWhatLiesInTheBox)
{
  const VoxelShape block = Box({ 10, 9, 8 }, { 100, -3, 7 });
  const auto       middle = CropToBox(block, { { 102, -1, 9 }, { 3, 2, 1 } });
  ExpectTight(middle.shape,
              { { 9, -1, 102 }, { 9, -1, 103 }, { 9, -1, 104 }, { 9, 0, 102 }, { 9, 0, 103 }, { 9, 0, 104 } });
  ExpectChange(middle, 720 - 6, 0, 0, 0, 0);
  ExpectChange(CropToBox(block, { { 0, -100, 0 }, { 1000, 1000, 1000 } }), 0, 0, 0, 0, 0);
  ExpectChange(CropToBox(block, { { 105, -1, 9 }, { 0, 2, 1 } }), 720, 0, 0, 0, 0);
  ExpectChange(CropToBox(block, { { 105, -1, 9 }, { 4, -2, 1 } }), 720, 0, 0, 0, 0);
  ExpectChange(CropToBox(block, { { 110, -1, 9 }, { 4, 2, 1 } }), 720, 0, 0, 0, 0); // beside it
  ExpectChange(CropToBox(block, { { 109, 5, 14 }, { 2147483647, 2147483647, 2147483647 } }), 719, 0, 0, 0, 0);
}

TEST(ShapeOperations, CropWorksAtTheEdgesOfWords)
{
  const VoxelShape row = ShapeWhere({ 200, 1, 1 }, [](int x, int, int) { return x % 3 != 1; }, { 5, 0, 0 });
  for (const std::int32_t from : { 0, 1, 62, 63, 64, 65, 127, 128, 129 })
  {
    for (const std::int32_t length : { 1, 2, 62, 63, 64, 65, 66, 127, 128, 129 })
    {
      Voxels expected;
      for (const Voxel & voxel : VoxelsOf(row))
      {
        if (voxel[2] >= 5 + from && voxel[2] < 5 + from + length)
        {
          expected.push_back(voxel);
        }
      }
      ExpectTight(CropToBox(row, { { 5 + from, 0, 0 }, { length, 1, 1 } }).shape, expected);
    }
  }
}

TEST(ShapeOperations, CountOfBitsIsThatOfEachBitOfAnyRange)
{
  const VoxelShape shape = ShapeWhere({ 200, 1, 1 }, [](int x, int, int) { return x % 3 != 1; });
  const auto       row = shape.Row(0, 0);
  for (std::int32_t begin = 0; begin <= 200; ++begin)
  {
    std::int32_t count = 0;
    for (std::int32_t end = begin; end <= 200; ++end)
    {
      ASSERT_EQ(CountBits(row, begin, end), count) << begin << " to " << end;
      count += end % 3 != 1 ? 1 : 0;
    }
  }
}

TEST(ShapeOperations, DustGoesAndWhatIsLargeEnoughStays)
{
  // A bar of 5, a bar of 3, a voxel that touches the first along an edge only, and a voxel by itself.
  VoxelShape shape(VoxelBox{ { 0, 0, 0 }, { 12, 4, 4 } });
  for (const std::int32_t x : { 0, 1, 2, 3, 4 })
  {
    shape.Insert(x, 0, 0);
  }
  for (const std::int32_t x : { 8, 9, 10 })
  {
    shape.Insert(x, 3, 3);
  }
  shape.Insert(5, 1, 0);
  shape.Insert(8, 0, 0);
  ExpectChange(RemoveSmallComponents(shape, 0), 0, 0, 0, 0, 0);
  ExpectChange(RemoveSmallComponents(shape, 1), 0, 0, 0, 0, 0);
  ExpectChange(RemoveSmallComponents(shape, 2), 2, 0, 2, 0, 0);
  ExpectChange(RemoveSmallComponents(shape, 3), 2, 0, 2, 0, 0);
  ExpectChange(RemoveSmallComponents(shape, 4), 5, 0, 3, 0, 0);
  ExpectChange(RemoveSmallComponents(shape, 6), 10, 0, 4, 0, 0);
  ExpectTight(RemoveSmallComponents(shape, 4).shape,
              { { 0, 0, 0 }, { 0, 0, 1 }, { 0, 0, 2 }, { 0, 0, 3 }, { 0, 0, 4 } });
  ExpectTight(RemoveSmallComponents(shape, 6).shape, {});
}

TEST(ShapeOperations, OfEqualComponentsTheFirstInScanOrderIsKept)
{
  // Three voxels apart; z counts most, then y, then x.
  VoxelShape shape(VoxelBox{ { 0, 0, 0 }, { 9, 9, 9 } });
  shape.Insert(0, 0, 5);
  shape.Insert(8, 3, 2);
  shape.Insert(1, 4, 2);
  ExpectTight(KeepLargestComponents(shape, 1).shape, { { 2, 3, 8 } });
  ExpectTight(KeepLargestComponents(shape, 2).shape, { { 2, 3, 8 }, { 2, 4, 1 } });
  ExpectChange(KeepLargestComponents(shape, 2), 1, 0, 1, 0, 0);
  ExpectChange(KeepLargestComponents(shape, 3), 0, 0, 0, 0, 0);
  ExpectChange(KeepLargestComponents(shape, 1000), 0, 0, 0, 0, 0);
  ExpectTight(KeepLargestComponents(shape, 0).shape, {});
  ExpectChange(KeepLargestComponents(shape, 0), 3, 0, 3, 0, 0);
  shape.Insert(0, 0, 6); // now the last one is the largest
  const auto parts = SplitComponents(shape);
  ASSERT_EQ(parts.size(), 3U);
  ExpectTight(parts[0], { { 5, 0, 0 }, { 6, 0, 0 } });
  ExpectTight(parts[1], { { 2, 3, 8 } });
  ExpectTight(parts[2], { { 2, 4, 1 } });
}

TEST(ShapeOperations, ACavityIsFilledAndAPotIsNot)
{
  VoxelShape shell = Hollow({ 5, 4, 6 });
  const auto filled = FillCavities(shell);
  ExpectChange(filled, 0, 3 * 2 * 4, 0, 0, 1);
  ExpectTight(filled.shape, VoxelsOf(Box({ 5, 4, 6 })));
  // Opened over a face, an edge or a corner the cavity is part of the outside.
  for (const Size3 & hole : { Size3{ 2, 2, 0 }, Size3{ 2, 0, 0 }, Size3{ 0, 0, 0 } })
  {
    const VoxelShape pot = ShapeWhere({ 5, 4, 6 }, [&](int x, int y, int z) {
      return shell.Contains(x, y, z) && Size3{ x, y, z } != hole;
    });
    ExpectChange(FillCavities(pot), 0, 0, 0, 0, 0);
    ExpectTight(FillCavities(pot).shape, VoxelsOf(pot));
  }
}

TEST(ShapeOperations, WhatFloatsInACavityBecomesPartOfWhatIsAroundIt)
{
  // A shell in a shell, a voxel in that, and a voxel outside: b0 = 4, b2 = 2.
  VoxelShape shape(VoxelBox{ { 0, 0, 0 }, { 12, 9, 9 } });
  for (const Voxel & voxel : VoxelsOf(Hollow({ 9, 9, 9 })))
  {
    shape.Insert(voxel[2], voxel[1], voxel[0]);
  }
  for (const Voxel & voxel : VoxelsOf(Hollow({ 5, 5, 5 })))
  {
    shape.Insert(voxel[2] + 2, voxel[1] + 2, voxel[0] + 2);
  }
  shape.Insert(4, 4, 4);
  shape.Insert(11, 4, 4);
  ASSERT_EQ(ComputeShapeTopology(shape).betti, (std::array<std::int64_t, 3>{ 4, 0, 2 }));
  const auto filled = FillCavities(shape);
  ExpectChange(filled, 0, (343 - 125) + (27 - 1), 0, 2, 2);
  EXPECT_EQ(ComputeShapeTopology(filled.shape).betti, (std::array<std::int64_t, 3>{ 2, 0, 0 }));
  EXPECT_EQ(filled.shape.CountVoxels(), 729U + 1U);
}

TEST(ShapeOperations, FillingRemovesTheHandlesOfACavitysWall)
{
  // A cube with a ring-shaped cavity: b1 = 1 for the ring, b2 = 1.
  const VoxelShape shape = ShapeWhere({ 5, 5, 5 }, [](int x, int y, int z) {
    const bool ring = z == 2 && x >= 1 && x <= 3 && y >= 1 && y <= 3 && (x != 2 || y != 2);
    return !ring;
  });
  ASSERT_EQ(ComputeShapeTopology(shape).betti, (std::array<std::int64_t, 3>{ 1, 1, 1 }));
  const auto filled = FillCavities(shape);
  ExpectChange(filled, 0, 8, 0, 0, 1);
  EXPECT_EQ(ComputeShapeTopology(filled.shape).betti, (std::array<std::int64_t, 3>{ 1, 0, 0 }));
}

TEST(ShapeOperations, RunsOverTheEdgesOfWordsAreSetAndCleared)
{
  for (const std::int32_t from : { 1, 62, 63, 64, 65, 127, 128 })
  {
    for (const std::int32_t length : { 1, 2, 63, 64, 65, 128, 129 })
    {
      // A tube with a cavity from `from` on, and in the row above it, apart, a bar of the same voxels.
      const auto       inner = [=](int x) { return x >= from && x < from + length; };
      const VoxelShape shape = ShapeWhere({ 260, 5, 3 }, [=](int x, int y, int z) {
        return y < 3 ? x <= from + length && (y != 1 || z != 1 || !inner(x)) : y == 4 && z == 1 && inner(x);
      });
      const auto       filled = FillCavities(shape);
      ExpectChange(filled, 0, static_cast<std::uint64_t>(length), 0, 0, 1);
      const auto largest = KeepLargestComponents(filled.shape, 1);
      ExpectChange(largest, static_cast<std::uint64_t>(length), 0, 1, 0, 0);
      ExpectTight(largest.shape, VoxelsOf(Box({ from + length + 1, 3, 3 })));
      const auto parts = SplitComponents(shape);
      ASSERT_EQ(parts.size(), 2U);
      ExpectTight(parts[1], VoxelsOf(Box({ length, 1, 1 }, { from, 4, 1 })));
    }
  }
}

TEST(ShapeOperations, ABoxThatIsNotTightChangesNothing)
{
  VoxelShape wide(VoxelBox{ { -70, -2, -3 }, { 200, 9, 9 } });
  for (const Voxel & voxel : VoxelsOf(Hollow({ 4, 4, 4 })))
  {
    wide.Insert(voxel[2], voxel[1], voxel[0]);
  }
  ExpectTight(KeepLargestComponents(wide, 1).shape, VoxelsOf(Hollow({ 4, 4, 4 })));
  ExpectTight(RemoveSmallComponents(wide, 1).shape, VoxelsOf(Hollow({ 4, 4, 4 })));
  ExpectTight(FillCavities(wide).shape, VoxelsOf(Box({ 4, 4, 4 })));
  ExpectTight(CropToBox(wide, wide.Box()).shape, VoxelsOf(Hollow({ 4, 4, 4 })));
  ExpectTight(CropToBox(wide, { { -5, -1, -1 }, { 9, 9, 9 } }).shape, VoxelsOf(Hollow({ 4, 4, 4 })));
  ExpectTight(SplitComponents(wide).at(0), VoxelsOf(Hollow({ 4, 4, 4 })));
}

} // namespace
} // namespace voxelcore::testing
