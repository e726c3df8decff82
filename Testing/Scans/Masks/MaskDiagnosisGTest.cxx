#include "VoxelCoreTesting/Random.h"
#include "VoxelCoreTesting/Shapes.h"

#include "voxelcore/Masks/MaskDiagnosis.h"
#include "voxelcore/Shape/ShapeTopology.h"

#include <cstdint>

#include <gtest/gtest.h>

namespace voxelcore::testing
{

namespace
{

/** A block pierced along z by holes `width` voxels wide, `walls` voxels apart: `perSide` squared loops. */
VoxelShape
PiercedBlock(std::int32_t perSide, std::int32_t width, std::int32_t walls)
{
  const std::int32_t side = perSide * (width + walls) + walls;
  VoxelShape         shape(VoxelBox{ { 0, 0, 0 }, { side, side, 3 } });
  const auto         isWall = [&](std::int32_t at) { return at % (width + walls) < walls; };
  for (std::int32_t z = 0; z < 3; ++z)
  {
    for (std::int32_t y = 0; y < side; ++y)
    {
      for (std::int32_t x = 0; x < side; ++x)
      {
        if (isWall(x) || isWall(y))
        {
          shape.Insert(x, y, z);
        }
      }
    }
  }
  return shape;
}

TEST(MaskDiagnosis, HolesOfAVoxelAreToldOfAndWideOnesAreNot)
{
  const VoxelShape narrow = PiercedBlock(11, 1, 3);
  ASSERT_EQ(ComputeShapeTopology(narrow).betti[1], 121);
  const MaskDiagnosis found = DiagnoseMask(narrow);
  EXPECT_TRUE(found.IsNoisy());
  EXPECT_EQ(found.loops, 121U);
  EXPECT_EQ(found.Sum(), 121U);
  EXPECT_EQ(found.NoiseText(), "121 loops a voxel wide");
  EXPECT_EQ(found.NoiseOptions(), "--mend-shape");

  const VoxelShape wide = PiercedBlock(11, 4, 3);
  ASSERT_EQ(ComputeShapeTopology(wide).betti[1], 121);
  EXPECT_FALSE(DiagnoseMask(wide).IsNoisy());
}

TEST(MaskDiagnosis, OneHoleOfAVoxelAmongFewWideOnesCountsAndAmongManyDoesNot)
{
  const auto pierced = [](std::int32_t perSide) {
    const VoxelShape block = PiercedBlock(perSide, 4, 3);
    return DiagnoseMask(
      ShapeWhere(block.Box().size, [&](int x, int y, int z) { return block.Contains(x, y, z) && (x != 1 || y != 1); }));
  };
  EXPECT_EQ(pierced(2).loops, 1U);
  EXPECT_TRUE(pierced(2).IsNoisy());
  EXPECT_EQ(pierced(4).loops, 1U);
  EXPECT_FALSE(pierced(4).IsNoisy()) << "one of 17";
}

TEST(MaskDiagnosis, IslandsHaveLessThanAHundredthOfTheLargestPiece)
{
  // A block of 10 x 10 x 10, and apart from it pieces of 9, 5 and 10 voxels.
  const VoxelShape    shape = ShapeWhere({ 40, 12, 10 }, [](int x, int y, int z) {
    return (x < 10 && y < 10) || (y == 5 && z == 5 && ((x >= 13 && x < 22) || (x >= 24 && x < 29))) ||
           (y == 9 && z == 5 && x >= 30);
  });
  const MaskDiagnosis found = DiagnoseMask(shape);
  EXPECT_EQ(found.islands, 2U);
  EXPECT_EQ(found.islandVoxels, 14U);
  EXPECT_EQ(found.VoxelsRemoved(), 14U);
  EXPECT_EQ(found.touching + found.torn + found.loops + found.cavities, 0U);
  EXPECT_TRUE(found.IsNoisy());
  EXPECT_EQ(found.NoiseOptions(), "--min-voxels 10");
}

TEST(MaskDiagnosis, OneFaultInABigBodyIsSilentAndAPieceTornOffIsNot)
{
  const auto diagnosed = [](int side, bool hasCavity, bool hasIsland) {
    return DiagnoseMask(ShapeWhere({ side + 5, side, side }, [&](int x, int y, int z) {
      return (x < side && !(hasCavity && x == 3 && y == 3 && z == 3)) ||
             (hasIsland && x == side + 3 && y == 4 && z == 4);
    }));
  };
  EXPECT_EQ(diagnosed(8, true, false).cavities, 1U);
  EXPECT_FALSE(diagnosed(8, true, false).IsNoisy()) << "one voxel of 512";
  EXPECT_TRUE(diagnosed(7, true, false).IsNoisy()) << "one voxel of 343";
  EXPECT_EQ(diagnosed(40, false, true).islands, 1U);
  EXPECT_FALSE(diagnosed(40, false, true).IsNoisy()) << "125 of 64,000";
  EXPECT_TRUE(diagnosed(30, false, true).IsNoisy());
  // A rod of 9 x 9 in two, a voxel apart.
  const MaskDiagnosis torn = DiagnoseMask(ShapeWhere({ 9, 9, 101 }, [](int, int, int z) { return z != 70; }));
  EXPECT_EQ(torn.torn, 1U);
  EXPECT_EQ(torn.tornVoxels, 30U * 81);
  EXPECT_TRUE(torn.IsNoisy());
}

TEST(MaskDiagnosis, ABodyMayBeATreeWhereNoiseMakesMostOfItsLoops)
{
  EXPECT_TRUE(DiagnoseMask(PiercedBlock(3, 1, 3)).MayBeTree());
  EXPECT_FALSE(DiagnoseMask(PiercedBlock(3, 4, 3)).MayBeTree()) << "wide holes";
  EXPECT_FALSE(
    DiagnoseMask(ShapeWhere({ 9, 9, 9 }, [](int x, int y, int) { return x < 4 ? !(x == 1 && y == 4) : x > 6; }))
      .MayBeTree())
    << "two pieces";
}

TEST(MaskDiagnosis, PiecesThatTouchAreNoIslands)
{
  // From a block a line of voxels over corners.
  const VoxelShape    shape = ShapeWhere({ 30, 30, 30 }, [](int x, int y, int z) {
    return (x < 10 && y < 10 && z < 10) || (x >= 10 && x == y && y == z);
  });
  const MaskDiagnosis found = DiagnoseMask(shape);
  EXPECT_EQ(found.topology.betti[0], 21);
  EXPECT_EQ(found.touching, 20U);
  EXPECT_EQ(found.touchingVoxels, 20U);
  EXPECT_EQ(found.Sum(), 0U);
  EXPECT_FALSE(found.IsNoisy());
  EXPECT_EQ(found.NoiseOptions(), "");
}

TEST(MaskDiagnosis, OfNoiseInABlockAreMostOfItsLoopsAndCavities)
{
  Random     random(7);
  VoxelShape shape(VoxelBox{ { 0, 0, 0 }, { 30, 30, 30 } });
  for (std::int32_t z = 0; z < 30; ++z)
  {
    for (std::int32_t y = 0; y < 30; ++y)
    {
      for (std::int32_t x = 0; x < 30; ++x)
      {
        if (!random.Chance(0.05))
        {
          shape.Insert(x, y, z);
        }
      }
    }
  }
  const TopologyNumbers topology = ComputeShapeTopology(shape);
  const MaskDiagnosis   found = DiagnoseMask(shape);
  EXPECT_TRUE(found.IsNoisy());
  EXPECT_GT(2 * found.cavities, static_cast<std::uint64_t>(topology.betti[2]));
}

} // namespace

} // namespace voxelcore::testing
