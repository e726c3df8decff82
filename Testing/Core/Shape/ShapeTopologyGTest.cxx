#include "voxelcore/Shape/ShapeTopology.h"

#include "VoxelCoreTesting/BruteShape.h"
#include "VoxelCoreTesting/Shapes.h"

#include <gtest/gtest.h>

#include <iostream>

namespace voxelcore
{

// For readable failures.
void
PrintTo(const TopologyNumbers & numbers, std::ostream * out)
{
  *out << "chi " << numbers.euler << ", b0 " << numbers.betti[0] << ", b1 " << numbers.betti[1] << ", b2 "
       << numbers.betti[2];
}

namespace
{

using testing::Box;
using testing::BruteComponents;
using testing::BruteTopology;
using testing::Random;
using testing::RandomShape;
using testing::ShapeWhere;
using testing::Size3;

TopologyNumbers
Numbers(std::int64_t euler, std::int64_t b0, std::int64_t b1, std::int64_t b2)
{
  return { euler, { b0, b1, b2 } };
}

TEST(ShapeTopology, NothingHasNothing)
{
  EXPECT_EQ(ComputeShapeTopology(VoxelShape(VoxelBox{ { 0, 0, 0 }, { 3, 3, 3 } })), Numbers(0, 0, 0, 0));
  EXPECT_EQ(ComputeShapeTopology(VoxelShape()), Numbers(0, 0, 0, 0));
  EXPECT_EQ(CountComponents26(VoxelShape()), 0);
}

TEST(ShapeTopology, AVoxelAndABlockAreBalls)
{
  EXPECT_EQ(ComputeShapeTopology(Box({ 1, 1, 1 })), Numbers(1, 1, 0, 0));
  for (const std::int32_t width : { 1, 63, 64, 65, 128, 130 })
  {
    EXPECT_EQ(ComputeShapeTopology(Box({ width, 3, 4 })), Numbers(1, 1, 0, 0)) << width;
  }
}

TEST(ShapeTopology, VoxelsThatTouchAlongAnEdgeOrACornerAreApart)
{
  const VoxelShape edge = ShapeWhere({ 2, 2, 1 }, [](int x, int y, int) { return x == y; });
  EXPECT_EQ(ComputeShapeTopology(edge), Numbers(2, 2, 0, 0));
  EXPECT_EQ(CountComponents26(edge), 1);
  const VoxelShape corner = ShapeWhere({ 2, 2, 2 }, [](int x, int y, int z) { return x == y && y == z; });
  EXPECT_EQ(ComputeShapeTopology(corner), Numbers(2, 2, 0, 0));
  EXPECT_EQ(CountComponents26(corner), 1);
  const VoxelShape gap = ShapeWhere({ 3, 1, 1 }, [](int x, int, int) { return x != 1; });
  EXPECT_EQ(ComputeShapeTopology(gap), Numbers(2, 2, 0, 0));
  EXPECT_EQ(CountComponents26(gap), 2);
}

TEST(ShapeTopology, AShellHasACavity)
{
  const VoxelShape shell = ShapeWhere({ 3, 3, 3 }, [](int x, int y, int z) { return x != 1 || y != 1 || z != 1; });
  EXPECT_EQ(ComputeShapeTopology(shell), Numbers(2, 1, 0, 1));
}

TEST(ShapeTopology, ACavityThatTouchesTheOutsideAlongAnEdgeIsNone)
{
  // The paper's figure 2 (a) in 3-D. The background is connected over edges and corners: a missing corner voxel of the
  // shell opens the cavity, and the shape's boundary is then one piece.
  const auto shellWithout = [](int cx, int cy, int cz) {
    return ShapeWhere({ 3, 3, 3 }, [=](int x, int y, int z) {
      return (x != 1 || y != 1 || z != 1) && (x != cx || y != cy || z != cz);
    });
  };
  EXPECT_EQ(ComputeShapeTopology(shellWithout(0, 0, 0)), Numbers(1, 1, 0, 0)); // touches at a corner
  EXPECT_EQ(ComputeShapeTopology(shellWithout(0, 0, 1)), Numbers(1, 1, 0, 0)); // along an edge
  EXPECT_EQ(ComputeShapeTopology(shellWithout(0, 1, 1)), Numbers(1, 1, 0, 0)); // a face: an open pot
}

TEST(ShapeTopology, TwoHolesJoinedDiagonallyAreOneCavity)
{
  // Two background voxels inside a block that touch only along an edge: the open block has one cavity; what is between
  // them is not in the shape.
  const VoxelShape block =
    ShapeWhere({ 4, 4, 3 }, [](int x, int y, int z) { return z != 1 || !((x == 1 && y == 1) || (x == 2 && y == 2)); });
  EXPECT_EQ(ComputeShapeTopology(block), Numbers(2, 1, 0, 1));
  const VoxelShape apart =
    ShapeWhere({ 5, 3, 3 }, [](int x, int y, int z) { return y != 1 || z != 1 || (x != 1 && x != 3); });
  EXPECT_EQ(ComputeShapeTopology(apart), Numbers(3, 1, 0, 2));
}

TEST(ShapeTopology, ARingHasALoop)
{
  const VoxelShape ring = ShapeWhere({ 3, 3, 1 }, [](int x, int y, int) { return x != 1 || y != 1; });
  EXPECT_EQ(ComputeShapeTopology(ring), Numbers(0, 1, 1, 0));
  // Without one corner voxel it is open: its ends touch nothing but along an edge.
  const VoxelShape open = ShapeWhere({ 3, 3, 1 }, [](int x, int y, int) { return (x != 1 || y != 1) && x + y != 0; });
  EXPECT_EQ(ComputeShapeTopology(open), Numbers(1, 1, 0, 0));
}

TEST(ShapeTopology, FourVoxelsAroundAnEdgeEncloseNoLoop)
{
  // 2 x 2 x 1: the middle edge has all four voxels, so no loop.
  EXPECT_EQ(ComputeShapeTopology(Box({ 2, 2, 1 })), Numbers(1, 1, 0, 0));
}

TEST(ShapeTopology, AFrameOfACubeHasFiveLoops)
{
  const VoxelShape frame =
    ShapeWhere({ 3, 3, 3 }, [](int x, int y, int z) { return (x != 1) + (y != 1) + (z != 1) >= 2; });
  EXPECT_EQ(ComputeShapeTopology(frame), Numbers(-4, 1, 5, 0));
}

TEST(ShapeTopology, EqualsTheRecountVoxelByVoxelAtEveryDensity)
{
  for (std::uint64_t seed = 1; seed <= 1000; ++seed)
  {
    const testing::RandomVolume volume = testing::MakeRandomVolume(seed, 1, 9);
    SCOPED_TRACE(volume.Describe());
    ASSERT_EQ(ComputeShapeTopology(volume.shape), BruteTopology(volume.shape));
    ASSERT_EQ(CountComponents26(volume.shape), BruteComponents(volume.shape, true, 3));
  }
}

TEST(ShapeTopology, EqualsTheRecountAtTheEdgesOfWords)
{
  Random random(77);
  for (const std::int32_t width : { 62, 63, 64, 65, 126, 127, 128, 129, 130 })
  {
    for (int round = 0; round < 20; ++round)
    {
      const double     density = 0.05 + 0.05 * (round % 19);
      const VoxelShape shape = RandomShape(random, { width, 3, 4 }, density);
      SCOPED_TRACE("width " + std::to_string(width) + ", round " + std::to_string(round));
      ASSERT_EQ(ComputeShapeTopology(shape), BruteTopology(shape));
      ASSERT_EQ(CountComponents26(shape), BruteComponents(shape, true, 3));
    }
  }
}

TEST(ShapeTopology, DoesNotDependOnTheMarginOrThePlace)
{
  Random random(78);
  for (int round = 0; round < 50; ++round)
  {
    const VoxelShape shape = RandomShape(random, { 66, 4, 4 }, 0.5);
    const VoxelShape padded = ShapeWhere({ 140, 7, 8 },
                                         [&](int x, int y, int z) { return shape.Contains(x - 63, y - 1, z - 2); },
                                         { 1000, -5, 0 });
    ASSERT_EQ(ComputeShapeTopology(shape), ComputeShapeTopology(padded)) << "round " << round;
    ASSERT_EQ(CountComponents26(shape), CountComponents26(padded)) << "round " << round;
  }
}

} // namespace
} // namespace voxelcore
