#include "VoxelCoreTesting/SurfaceNoise.h"
#include "VoxelCoreTesting/Threads.h"

#include "voxelcore/Masks/ShapeSmoothing.h"
#include "voxelcore/Shape/ShapeTopology.h"

#include <gtest/gtest.h>

namespace voxelcore::testing
{
namespace
{

using MendingNumbers = std::array<std::uint64_t, 5>;

/** Voxels added and removed, pieces joined, loops closed, cavities filled. */
MendingNumbers
NumbersOf(const MendedShape & mended)
{
  return { mended.voxelsAdded, mended.voxelsRemoved, mended.piecesJoined, mended.loopsClosed, mended.cavitiesFilled };
}

TEST(ShapeMending, FillsAHoleOfOneVoxel)
{
  const VoxelShape plate = ShapeWhere({ 9, 9, 1 }, [](int x, int y, int) { return x != 4 || y != 4; });
  const auto       mended = MendShape(plate);
  EXPECT_EQ(NumbersOf(mended), (MendingNumbers{ 1, 0, 0, 1, 0 }));
  EXPECT_EQ(mended.shape.CountVoxels(), 81U);
}

TEST(ShapeMending, LeavesAHoleOfTwoVoxels)
{
  const VoxelShape plate =
    ShapeWhere({ 9, 9, 1 }, [](int x, int y, int) { return !((x == 4 || x == 5) && (y == 4 || y == 5)); });
  EXPECT_EQ(NumbersOf(MendShape(plate)), MendingNumbers{});
}

TEST(ShapeMending, FillsACavityOfOneVoxel)
{
  const VoxelShape block = ShapeWhere({ 5, 5, 5 }, [](int x, int y, int z) { return x != 2 || y != 2 || z != 2; });
  EXPECT_EQ(NumbersOf(MendShape(block)), (MendingNumbers{ 1, 0, 0, 0, 1 }));
}

TEST(ShapeMending, JoinsARodThatWasCut)
{
  const VoxelShape rod = ShapeWhere({ 21, 1, 1 }, [](int x, int, int) { return x % 7 != 3; });
  const auto       mended = MendShape(rod);
  EXPECT_EQ(NumbersOf(mended), (MendingNumbers{ 3, 0, 3, 0, 0 }));
  EXPECT_EQ(mended.shape.CountVoxels(), 21U);
}

TEST(ShapeMending, JoinsWhatMeetsAtACorner)
{
  const VoxelShape cubes = ShapeWhere({ 8, 8, 8 }, [](int x, int y, int z) {
    return (x < 4 && y < 4 && z < 4) || (x >= 4 && y >= 4 && z >= 4);
  });
  const auto       mended = MendShape(cubes);
  EXPECT_EQ(mended.piecesJoined, 1U);
  EXPECT_EQ(mended.voxelsAdded, 2U);
  EXPECT_EQ(ComputeShapeTopology(mended.shape).betti, (std::array<std::int64_t, 3>{ 1, 0, 0 }));
}

TEST(ShapeMending, DoesNotCloseARingThatIsOpen)
{
  // Joining the two ends would make a loop.
  const VoxelShape ring = ShapeWhere({ 9, 9, 1 }, [](int x, int y, int) {
    return (x == 0 || y == 0 || x == 8 || y == 8) && (x != 4 || y != 0);
  });
  EXPECT_EQ(NumbersOf(MendShape(ring)), MendingNumbers{});
}

TEST(ShapeMending, TakesABridgeOverABayAwayAndLeavesAThinRing)
{
  // On a block a bow of three voxels.
  const VoxelShape bow = ShapeWhere({ 11, 11, 7 }, [](int x, int y, int z) {
    return z < 5 || (y == 5 && ((z == 5 && (x == 4 || x == 6)) || (z == 6 && x >= 4 && x <= 6)));
  });
  ASSERT_EQ(ComputeShapeTopology(bow).betti[1], 1);
  const auto mended = MendShape(bow);
  EXPECT_EQ(mended.loopsClosed, 1U);
  EXPECT_EQ(ComputeShapeTopology(mended.shape).betti, (std::array<std::int64_t, 3>{ 1, 0, 0 }));
  const VoxelShape ring =
    ShapeWhere({ 7, 7, 1 }, [](int x, int y, int) { return x == 0 || y == 0 || x == 6 || y == 6; });
  EXPECT_EQ(NumbersOf(MendShape(ring)), MendingNumbers{});
}

TEST(ShapeMending, LowersTheNumbersItCountsAndNoOther)
{
  std::uint64_t joined = 0;
  std::uint64_t closed = 0;
  std::uint64_t filled = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed)
  {
    const RandomVolume volume = MakeRandomVolume(seed, 1, 14);
    const auto         mended = MendShape(volume.shape);
    const auto         before = ComputeShapeTopology(volume.shape).betti;
    const auto         after = ComputeShapeTopology(mended.shape).betti;
    ASSERT_EQ(before[0] - after[0], static_cast<std::int64_t>(mended.piecesJoined)) << volume.Describe();
    ASSERT_EQ(before[1] - after[1], static_cast<std::int64_t>(mended.loopsClosed)) << volume.Describe();
    ASSERT_EQ(before[2] - after[2], static_cast<std::int64_t>(mended.cavitiesFilled)) << volume.Describe();
    ASSERT_EQ(mended.shape.CountVoxels() + mended.voxelsRemoved, volume.shape.CountVoxels() + mended.voxelsAdded);
    joined += mended.piecesJoined;
    closed += mended.loopsClosed;
    filled += mended.cavitiesFilled;
  }
  EXPECT_GT(joined, 500U);
  EXPECT_GT(closed, 500U);
  EXPECT_GT(filled, 30U);
}

TEST(ShapeMending, TakesBackWhatNoiseDidToATorus)
{
  const std::int32_t n = 40;
  const VoxelShape   torus = ShapeWhere({ n, n, n }, [](int x, int y, int z) {
    const double u = std::hypot(x + 0.5 - 20, y + 0.5 - 20) - 13;
    return std::hypot(u, z + 0.5 - 20) <= 3.2;
  });
  EXPECT_EQ(NumbersOf(MendShape(torus)), MendingNumbers{}) << "a clean one has nothing to mend";
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
  {
    const VoxelShape rough = Flipped(torus, n, seed, false);
    EXPECT_NE(ComputeShapeTopology(rough), ComputeShapeTopology(torus)) << "seed " << seed;
    const Threads threads(static_cast<int>(seed));
    EXPECT_EQ(ComputeShapeTopology(MendShape(rough).shape), ComputeShapeTopology(torus)) << "seed " << seed;
  }
}

TEST(ShapeMending, StopsWhenAsked)
{
  EXPECT_THROW(MendShape(Box({ 4, 4, 4 }), [](std::string_view, double) { return false; }), Cancelled);
}

} // namespace
} // namespace voxelcore::testing
