#include "VoxelCoreTesting/Random.h"
#include "VoxelCoreTesting/Shapes.h"

#include "voxelcore/FineTopology.h"
#include "voxelcore/ShapeTopology.h"

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

std::optional<FineTopology>
Found(const VoxelShape & shape)
{
  return FindFineTopology(shape, ComputeShapeTopology(shape));
}

TEST(FineTopology, HolesOfAVoxelAreToldOfAndWideOnesAreNot)
{
  const VoxelShape narrow = PiercedBlock(11, 1, 3);
  ASSERT_EQ(ComputeShapeTopology(narrow).betti[1], 121);
  const auto fine = Found(narrow);
  ASSERT_TRUE(fine);
  EXPECT_EQ(fine->loops, 121U);
  EXPECT_EQ(fine->Sum(), 121U);

  const VoxelShape wide = PiercedBlock(11, 4, 3);
  ASSERT_EQ(ComputeShapeTopology(wide).betti[1], 121);
  EXPECT_FALSE(Found(wide));
}

TEST(FineTopology, AFewAreNot)
{
  EXPECT_FALSE(Found(PiercedBlock(7, 1, 3)));
}

TEST(FineTopology, SpecksAndPiecesAVoxelApartCount)
{
  // One block of 5 x 5 x 3, and specks in rows: 150 of two voxels, four apart.
  VoxelShape shape(VoxelBox{ { 0, 0, 0 }, { 100, 100, 3 } });
  for (std::int32_t i = 0; i < 150; ++i)
  {
    shape.Insert(5 * (i % 15), 5 * (i / 15), 0);
    shape.Insert(5 * (i % 15), 5 * (i / 15), 1);
  }
  for (std::int32_t i = 0; i < 75; ++i)
  {
    shape.Insert(90 + i % 5, 90 + i / 5 % 5, i / 25);
  }
  const auto fine = Found(shape);
  ASSERT_TRUE(fine);
  EXPECT_EQ(fine->joined + fine->specks, 150U);
  EXPECT_EQ(fine->loops, 0U);
}

TEST(FineTopology, OfNoiseInABlockAreMostOfItsLoopsAndCavities)
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
  const auto            fine = Found(shape);
  ASSERT_TRUE(fine);
  EXPECT_GT(2 * fine->cavities, static_cast<std::uint64_t>(topology.betti[2]));
}

} // namespace

} // namespace voxelcore::testing
