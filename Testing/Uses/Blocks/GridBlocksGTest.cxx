// Blocks that are read through windows join to the cells of one run, and read no more than they need.

#include "voxelcore/Blocks/GridBlocks.h"

#include "HaloBlocksFixture.h"
#include "Core/Delaunay/EngineFixture.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Shape/ShapeOperations.h"

#include <algorithm>
#include <iostream>
#include <sstream>

namespace voxelcore
{
namespace
{

/** The shape's box with some room, as scans have. */
VoxelBox
ScanAround(const VoxelShape & shape, std::int32_t room)
{
  VoxelBox scan = shape.Box();
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    scan.lower[axis] -= room;
    scan.size[axis] += 2 * room + static_cast<std::int32_t>(axis);
  }
  return scan;
}

/** Gives parts of a shape, and remembers the greatest one asked for. */
struct Scan
{
  const VoxelShape &          shape;
  std::array<std::int32_t, 3> greatest{ 0, 0, 0 };

  RegionReader
  Reader()
  {
    return [this](const VoxelBox & box) {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        greatest[axis] = std::max(greatest[axis], box.size[axis]);
      }
      return CropToBox(shape, box).shape;
    };
  }
};

void
ExpectJoinOfGrid(const testing::WholeShape & whole, std::int32_t room, std::int32_t side)
{
  SCOPED_TRACE("room " + std::to_string(room) + ", blocks of " + std::to_string(side));
  const VoxelBox          scan = ScanAround(whole.shape, room);
  const BlockPlan         plan = PlanGrid(scan, whole.weights, side);
  Scan                    source{ whole.shape };
  std::vector<BlockShare> shares;
  for (std::size_t block = 0; block < plan.blocks.size(); ++block)
  {
    shares.push_back(ComputeBlockShare(source.Reader(), scan, whole.weights, plan, block, whole.engine));
  }
  ASSERT_NO_FATAL_FAILURE(whole.ExpectJoined(JoinBlockShares(shares)));
}

TEST(GridBlocks, JoinToTheCellsOfOneRun)
{
  std::cout << "seeds 1 to 60\n";
  for (std::uint64_t seed = 1; seed <= 60; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const testing::RandomVolume volume = testing::MakeRandomVolume(seed, 4, 30);
    const testing::WholeShape   whole(volume.shape, volume.spacing);
    ASSERT_NO_FATAL_FAILURE(
      ExpectJoinOfGrid(whole, static_cast<std::int32_t>(seed % 3) * 5, 8 + static_cast<std::int32_t>(seed % 11)));
  }
}

TEST(GridBlocks, ReachFurtherWhereBallsDo)
{
  // Blocks in the middle see no boundary through their first window.
  const std::int32_t        side = 130;
  const testing::WholeShape ball(testing::ShapeWhere({ side, side, side }, [](int x, int y, int z) {
    const auto square = [](int at) { return (2 * at - 129) * (2 * at - 129); };
    return square(x) + square(y) + square(z) < 129 * 129;
  }));
  ASSERT_NO_FATAL_FAILURE(ExpectJoinOfGrid(ball, 3, 40));
  const testing::WholeShape full(testing::ShapeWhere({ 90, 80, 70 }, [](int, int, int) { return true; }), { 1, 1, 2 });
  ASSERT_NO_FATAL_FAILURE(ExpectJoinOfGrid(full, 0, 32)); // the scan's end is the shape's
}

TEST(GridBlocks, ReadNoMoreThanTheyNeed)
{
  const testing::WholeShape rod(testing::ShapeWhere({ 900, 5, 6 }, [](int, int, int) { return true; }));
  const VoxelBox            scan = ScanAround(rod.shape, 100);
  const BlockPlan           plan = PlanGrid(scan, rod.weights, 100);
  Scan                      source{ rod.shape };
  for (std::size_t block = 0; block < plan.blocks.size(); ++block)
  {
    ComputeBlockShare(source.Reader(), scan, rod.weights, plan, block, Engine::Lattice);
  }
  for (const std::int32_t size : source.greatest)
  {
    EXPECT_LE(size, 100 + 2 * 16 + 3);
  }
}

TEST(GridBlocks, MayHoldNothing)
{
  const VoxelBox          scan{ { 0, 0, 0 }, { 40, 40, 40 } };
  const SpacingWeights    weights = ComputeSpacingWeights({ 1, 1, 1 });
  const BlockPlan         plan = PlanGrid(scan, weights, 20);
  std::vector<BlockShare> shares;
  ASSERT_EQ(plan.blocks.size(), 8U);
  for (std::size_t block = 0; block < 8; ++block)
  {
    shares.push_back(ComputeBlockShare([](const VoxelBox &) { return VoxelShape(); }, scan, weights, plan, block));
    EXPECT_TRUE(shares.back().points.empty());
  }
  EXPECT_TRUE(JoinBlockShares(shares).points.empty());
}

TEST(GridBlocks, AMissingSquareIsSeen)
{
  const VoxelShape        shape = testing::ShapeWhere({ 30, 12, 12 }, [](int, int, int) { return true; });
  const SpacingWeights    weights = ComputeSpacingWeights({ 1, 1, 1 });
  const BlockPlan         plan = PlanGrid(shape.Box(), weights, 10);
  Scan                    source{ shape };
  std::vector<BlockShare> shares;
  for (std::size_t block = 0; block < plan.blocks.size(); ++block)
  {
    shares.push_back(ComputeBlockShare(source.Reader(), shape.Box(), weights, plan, block));
  }
  ++shares[1].ownSquares;
  EXPECT_THROW(JoinBlockShares(shares), CertificateError);
}

TEST(GridBlocks, SharesSurviveAFileWithTheirSquares)
{
  const VoxelShape     shape = testing::ShapeWhere({ 30, 12, 12 }, [](int, int, int) { return true; });
  const SpacingWeights weights = ComputeSpacingWeights({ 1, 1, 1 });
  const BlockPlan      plan = PlanGrid(shape.Box(), weights, 10);
  Scan                 source{ shape };
  const BlockShare     share = ComputeBlockShare(source.Reader(), shape.Box(), weights, plan, 0);
  std::stringstream    file;
  WriteBlockShare(share, file);
  const BlockShare back = ReadBlockShare(file, "memory");
  EXPECT_EQ(back.ownSquares, share.ownSquares);
  EXPECT_TRUE(back.topology == share.topology);
  EXPECT_GT(back.ownSquares, 200U);
  EXPECT_EQ(back.boundaryVertices, kNotCounted);
}

TEST(GridBlocks, PartTheCornersOfTheScan)
{
  const VoxelBox       scan{ { -5, 7, 0 }, { 64, 65, 20 } };
  const SpacingWeights weights = ComputeSpacingWeights({ 1, 1, 1 });
  const BlockPlan      plan = PlanGrid(scan, weights, 32);
  std::int64_t         corners = 0;
  for (const HaloBlock & block : plan.blocks)
  {
    corners +=
      std::int64_t{ block.upper.x - block.lower.x } * (block.upper.y - block.lower.y) * (block.upper.z - block.lower.z);
  }
  EXPECT_EQ(corners, std::int64_t{ 65 } * 66 * 21);
  EXPECT_EQ(plan.blocks.size(), 2U * 3U * 1U);
  EXPECT_EQ(plan.blocks.front().lower, (LatticePoint{ -5, 7, 0 }));
  EXPECT_EQ(plan.blocks.back().upper, (LatticePoint{ 60, 73, 21 }));
  EXPECT_THROW(PlanGrid(scan, weights, 4), UsageError);
  EXPECT_THROW(PlanGrid({ { 0, 0, 0 }, { 100000, 100000, 100000 } }, weights, 8), UsageError);
  EXPECT_THROW(ComputeBlockShare([](const VoxelBox &) { return VoxelShape(); }, scan, weights, plan, 6), UsageError);
}

} // namespace
} // namespace voxelcore
