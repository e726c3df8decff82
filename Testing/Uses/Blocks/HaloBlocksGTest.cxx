// The cells of a shape computed block by block and joined are those of one run, to the last bit.

#include "voxelcore/Blocks/HaloBlocks.h"

#include "Core/Delaunay/EngineFixture.h"
#include "HaloBlocksFixture.h"

#include "voxelcore/Base/Error.h"

#include <algorithm>
#include <cmath>
#include <iostream>

namespace voxelcore
{
namespace
{

using testing::Box;
using testing::ShapeWhere;
using testing::WholeShape;

VoxelShape
Ball(std::int32_t size, double radius)
{
  return ShapeWhere({ size, size, size }, [=](int x, int y, int z) {
    const auto square = [=](int at) { return (at + 0.5 - 0.5 * size) * (at + 0.5 - 0.5 * size); };
    return square(x) + square(y) + square(z) <= radius * radius;
  });
}

// The eight octants around a lattice corner.
std::vector<HaloBlock>
Octants(const VoxelShape & shape, const LatticePoint & c)
{
  const auto & [lower, size] = shape.Box();
  const LatticePoint     low{ lower[0], lower[1], lower[2] };
  const LatticePoint     high{ low.x + size[0] + 1, low.y + size[1] + 1, low.z + size[2] + 1 };
  std::vector<HaloBlock> blocks;
  for (int i = 0; i < 8; ++i)
  {
    const bool x = (i & 1) != 0;
    const bool y = (i & 2) != 0;
    const bool z = (i & 4) != 0;
    blocks.push_back({ { x ? c.x : low.x, y ? c.y : low.y, z ? c.z : low.z },
                       { x ? high.x : c.x, y ? high.y : c.y, z ? high.z : c.z } });
  }
  return blocks;
}

class HaloBlocks : public testing::WithEngine
{
protected:
  static void
  ExpectOnRandomVolumes(std::uint64_t first, std::uint64_t count, std::int32_t least, std::int32_t greatest)
  {
    std::cout << "seeds " << first << " to " << first + count - 1 << '\n';
    for (std::uint64_t seed = first; seed < first + count; ++seed)
    {
      const testing::RandomVolume volume = testing::MakeRandomVolume(seed, least, greatest);
      SCOPED_TRACE(volume.Describe());
      const WholeShape whole(volume.shape, volume.spacing, GetParam());
      ASSERT_NO_FATAL_FAILURE(whole.ExpectJoinOf({ 1, 2, 3, 8 }));
    }
  }

  // Full of voxels but for a few: large balls, and cospherical points in plenty.
  static void
  ExpectOnSolidsWithHoles(std::uint64_t first, std::uint64_t count, std::int32_t least, std::int32_t greatest)
  {
    std::cout << "seeds " << first << " to " << first + count - 1 << '\n';
    for (std::uint64_t seed = first; seed < first + count; ++seed)
    {
      testing::RandomVolume volume = testing::MakeRandomVolume(seed, least, greatest);
      testing::Random       random(seed);
      const double          holes = seed % 4 == 0 ? 0.0 : seed % 4 == 1 ? 0.0005 : seed % 4 == 2 ? 0.003 : 0.02;
      volume.shape =
        ShapeWhere(volume.shape.Box().size, [&](int, int, int) { return !random.Chance(holes); }, { -7, 1000, 40 });
      SCOPED_TRACE(volume.Describe());
      const WholeShape whole(volume.shape, volume.spacing, GetParam());
      ASSERT_NO_FATAL_FAILURE(whole.ExpectJoinOf({ 2, 5 }));
      // Cut at random corners, too: the planner's cuts are wise.
      const auto & [lower, size] = volume.shape.Box();
      const LatticePoint corner{ lower[0] + static_cast<std::int32_t>(random.Between(0, size[0])),
                                 lower[1] + static_cast<std::int32_t>(random.Between(0, size[1])),
                                 lower[2] + static_cast<std::int32_t>(random.Between(0, size[2])) };
      SCOPED_TRACE("octants");
      ASSERT_NO_FATAL_FAILURE(whole.ExpectJoinOf(PlanBlocks(whole.shape, whole.weights, Octants(whole.shape, corner))));
    }
  }
};

class HeavyHaloBlocks : public HaloBlocks
{};

INSTANTIATE_TEST_SUITE_P(Engines, HaloBlocks, testing::AllEngines(), testing::EngineName);
INSTANTIATE_TEST_SUITE_P(Engines, HeavyHaloBlocks, testing::AllEngines(), testing::EngineName);

TEST_P(HaloBlocks, JoinOfRandomVolumesIsTheWhole)
{
  ExpectOnRandomVolumes(40000, GetParam() == Engine::Lattice ? 100 : 4, 1, 14);
}

TEST_P(HeavyHaloBlocks, JoinOfRandomVolumesIsTheWhole)
{
  ExpectOnRandomVolumes(41000, GetParam() == Engine::Lattice ? 600 : 40, 1, 20);
}

TEST_P(HaloBlocks, JoinOfSolidsWithHolesIsTheWhole)
{
  ExpectOnSolidsWithHoles(42000, GetParam() == Engine::Lattice ? 32 : 3, 4, 18);
}

TEST_P(HeavyHaloBlocks, JoinOfSolidsWithHolesIsTheWhole)
{
  ExpectOnSolidsWithHoles(43000, GetParam() == Engine::Lattice ? 80 : 12, 12, 36);
}

TEST_P(HaloBlocks, ACentreOnBlockBordersBelongsToOneBlock)
{
  // The centre of the ball is the corner where all blocks meet, and one cell has it as its centre.
  const WholeShape ball(Ball(18, 8.6), { 1, 1, 1 }, GetParam());
  const BlockPlan  octants = PlanBlocks(ball.shape, ball.weights, Octants(ball.shape, { 9, 9, 9 }));
  EXPECT_EQ(std::count(ball.cells.centres.begin(), ball.cells.centres.end(), std::array<double, 3>{ 9, 9, 9 }), 1);
  ASSERT_NO_FATAL_FAILURE(ball.ExpectJoinOf(octants));
  std::size_t cells = 0;
  for (const BlockShare & share : testing::SharesOf(ball.shape, ball.weights, octants, GetParam()))
  {
    cells += share.cells.CellCount();
  }
  EXPECT_EQ(cells, ball.cells.CellCount());
}

TEST(BlocksOfThickShapes, AreExactWhereHalosAreMarkedInCubes)
{
  for (const testing::Spacing3 & spacing : { testing::Spacing3{ 1, 1, 1 }, testing::Spacing3{ 1, 1, 2 } })
  {
    const WholeShape ball(Ball(46, 22), spacing);
    ASSERT_NO_FATAL_FAILURE(
      ball.ExpectJoinOf(PlanBlocks(ball.shape, ball.weights, Octants(ball.shape, { 17, 24, 25 }))));
  }
}

TEST_P(HaloBlocks, AMedialPlaneOnABlockBorderBelongsToTheUpperBlock)
{
  const WholeShape box(Box({ 8, 20, 17 }), { 1, 1, 1 }, GetParam());
  const BlockPlan  halves =
    PlanBlocks(box.shape,
               box.weights,
               std::vector<HaloBlock>{ { { 0, 0, 0 }, { 4, 21, 18 } }, { { 4, 0, 0 }, { 9, 21, 18 } } });
  ASSERT_NO_FATAL_FAILURE(box.ExpectJoinOf(halves));
  const auto onPlane = std::count_if(box.cells.centres.begin(), box.cells.centres.end(), [](const auto & centre) {
    return centre[0] == 4;
  });
  const auto below = std::count_if(box.cells.centres.begin(), box.cells.centres.end(), [](const auto & centre) {
    return centre[0] < 4;
  });
  ASSERT_GT(onPlane, 100);
  EXPECT_EQ(ComputeBlockShare(box.shape, box.weights, halves, 0, GetParam()).cells.CellCount(), below);
  EXPECT_EQ(ComputeBlockShare(box.shape, box.weights, halves, 1, GetParam()).cells.CellCount(),
            box.cells.CellCount() - static_cast<std::size_t>(below));
  // The planner, too, halves a cube through its middle.
  const WholeShape cube(Box({ 12, 12, 12 }, { 5, 5, 5 }), { 1, 1, 1 }, GetParam());
  const BlockPlan  plan = PlanBlocks(cube.shape, cube.weights, 8);
  EXPECT_EQ(plan.blocks[0].upper, (LatticePoint{ 11, 11, 11 }));
  ASSERT_NO_FATAL_FAILURE(cube.ExpectJoinOf(plan));
}

TEST_P(HaloBlocks, AnisotropicSpacingsAreHeeded)
{
  // TetGen takes its time: it is given less.
  const bool                     lattice = GetParam() == Engine::Lattice;
  const std::vector<std::size_t> counts = lattice ? std::vector<std::size_t>{ 2, 3, 8 } : std::vector<std::size_t>{ 3 };
  for (const testing::Spacing3 & spacing :
       { testing::Spacing3{ 1, 1, 4 }, testing::Spacing3{ 2, 3, 5 }, testing::Spacing3{ 4096, 1, 1 } })
  {
    SCOPED_TRACE(spacing[0]);
    ASSERT_NO_FATAL_FAILURE(WholeShape(Ball(15, 7.4), spacing, GetParam()).ExpectJoinOf(counts));
    ASSERT_NO_FATAL_FAILURE(WholeShape(Box({ 9, 16, 12 }), spacing, GetParam()).ExpectJoinOf(counts));
    if (lattice)
    {
      ASSERT_NO_FATAL_FAILURE(WholeShape(testing::Ellipsoid(32), spacing, GetParam()).ExpectJoinOf(counts));
    }
  }
}

TEST_P(HaloBlocks, BlocksMayHaveNoCells)
{
  // Two voxels in far corners of a large box, blocks that are all background, and blocks without extent.
  VoxelShape shape(VoxelBox{ { 100, -50, 3 }, { 70, 40, 60 } });
  shape.Insert(100, -50, 3);
  shape.Insert(169, -11, 62);
  const WholeShape corners(shape, { 1, 1, 1 }, GetParam());
  ASSERT_EQ(corners.cells.CellCount(), 2U);
  ASSERT_NO_FATAL_FAILURE(corners.ExpectJoinOf({ 1, 2, 3, 8, 40 }));
  ASSERT_NO_FATAL_FAILURE(corners.ExpectJoinOf(PlanBlocks(shape, corners.weights, Octants(shape, { 130, -30, 30 }))));
  ASSERT_NO_FATAL_FAILURE(corners.ExpectJoinOf(PlanBlocks(shape, corners.weights, Octants(shape, { 100, -50, 3 }))));
  ASSERT_NO_FATAL_FAILURE(WholeShape(Box({ 1, 1, 1 }), { 1, 1, 1 }, GetParam()).ExpectJoinOf({ 1, 2, 8, 9, 30 }));
  ASSERT_NO_FATAL_FAILURE(
    WholeShape(VoxelShape(VoxelBox{ { 0, 0, 0 }, { 5, 5, 5 } }), { 1, 1, 1 }, GetParam()).ExpectJoinOf({ 1, 3 }));
  ASSERT_NO_FATAL_FAILURE(WholeShape(VoxelShape(), { 1, 1, 1 }, GetParam()).ExpectJoinOf({ 1, 3 }));
}

TEST_P(HaloBlocks, EnginesGiveEachOthersShares)
{
  const VoxelShape        shape = testing::Ellipsoid(48);
  const SpacingWeights    weights = ComputeSpacingWeights({ 1, 1, 2 });
  const BlockPlan         plan = PlanBlocks(shape, weights, 3);
  std::vector<BlockShare> mixed;
  for (std::size_t block = 0; block < 3; ++block)
  {
    mixed.push_back(ComputeBlockShare(shape, weights, plan, block, block == 1 ? Engine::Lattice : GetParam()));
  }
  std::swap(mixed[0], mixed[2]); // in any order
  WholeShape(shape, { 1, 1, 2 }, GetParam()).ExpectJoined(JoinBlockShares(mixed));
}

TEST(BlockPlans, PartTheCornersEvenlyAndAreTheSameEveryTime)
{
  const VoxelShape     shape = testing::Ellipsoid(64);
  const SpacingWeights weights;
  for (const std::size_t count : { 1, 2, 3, 5, 8, 17 })
  {
    SCOPED_TRACE(count);
    const BlockPlan plan = PlanBlocks(shape, weights, count);
    const BlockPlan again = PlanBlocks(shape, weights, count);
    ASSERT_EQ(plan.blocks.size(), count);
    EXPECT_TRUE(plan.blocks == again.blocks && plan.digest == again.digest);
    const auto points = BoundaryVertices(shape);
    EXPECT_EQ(plan.boundaryVertices, points.size());
    std::size_t total = 0;
    for (const HaloBlock & block : plan.blocks)
    {
      const auto within = static_cast<std::size_t>(std::count_if(points.begin(), points.end(), [&](const auto & p) {
        return p.x >= block.lower.x && p.x < block.upper.x && p.y >= block.lower.y && p.y < block.upper.y &&
               p.z >= block.lower.z && p.z < block.upper.z;
      }));
      total += within;
      EXPECT_LT(within * count, points.size() * 13 / 10);
      EXPECT_GT(within * count, points.size() * 7 / 10);
    }
    EXPECT_EQ(total, points.size());
    // Blocks of one's own have to part the corners, and these do.
    EXPECT_EQ(PlanBlocks(shape, weights, plan.blocks).digest, plan.digest);
  }
}

TEST(BlockPlans, TellShapesWeightsAndBlocksApart)
{
  const VoxelShape     shape = Box({ 9, 7, 5 });
  const SpacingWeights weights;
  const BlockPlan      plan = PlanBlocks(shape, weights, 3);
  EXPECT_TRUE(IsPlanOf(plan, shape, weights));
  EXPECT_FALSE(IsPlanOf(plan, shape, ComputeSpacingWeights({ 1, 1, 2 })));
  EXPECT_FALSE(IsPlanOf(plan, Box({ 9, 7, 5 }, { 1, 0, 0 }), weights));
  VoxelShape dented = shape;
  dented.Row(3, 3)[0] ^= 16;
  EXPECT_FALSE(IsPlanOf(plan, dented, weights));
  BlockPlan changed = plan;
  --changed.blocks[0].upper.x;
  EXPECT_FALSE(IsPlanOf(changed, shape, weights));
  EXPECT_THROW(ComputeBlockShare(dented, weights, plan, 0), InputError);
  EXPECT_THROW(ComputeBlockShare(shape, weights, changed, 0), InputError);
  EXPECT_THROW(ComputeBlockShare(shape, weights, plan, 3), UsageError);
}

TEST(BlockPlans, RefuseWhatCannotBe)
{
  const VoxelShape     shape = Box({ 4, 4, 4 });
  const SpacingWeights weights;
  EXPECT_THROW(PlanBlocks(shape, weights, std::size_t{ 0 }), UsageError);
  EXPECT_THROW(PlanBlocks(shape, weights, (std::size_t{ 1 } << 20) + 1), UsageError);
  using Blocks = std::vector<HaloBlock>;
  const HaloBlock all{ { 0, 0, 0 }, { 5, 5, 5 } };
  EXPECT_NO_THROW(PlanBlocks(shape, weights, Blocks{ all }));
  EXPECT_THROW(PlanBlocks(shape, weights, Blocks{}), UsageError);
  EXPECT_THROW(PlanBlocks(shape, weights, Blocks{ { { 0, 0, 0 }, { 4, 5, 5 } } }), UsageError);
  EXPECT_THROW(PlanBlocks(shape, weights, Blocks{ all, all }), UsageError);
  EXPECT_THROW(PlanBlocks(shape, weights, Blocks{ { { 0, 0, 0 }, { 5, 5, 6 } } }), UsageError);
  EXPECT_THROW(PlanBlocks(shape, weights, Blocks{ { { 0, 0, 0 }, { 3, 5, 5 } }, { { 2, 0, 0 }, { 5, 5, 5 } } }),
               UsageError);
  EXPECT_THROW(PlanBlocks(VoxelShape(VoxelBox{ { 0, 0, 0 }, { (1 << 20) + 1, 1, 1 } }), weights, std::size_t{ 2 }),
               InputError);
}

TEST(BlockPlans, WorkIsCancelledWhenAsked)
{
  const VoxelShape     shape = testing::Ellipsoid(40);
  const SpacingWeights weights;
  const BlockPlan      plan = PlanBlocks(shape, weights, 2);
  const auto           no = [](std::string_view, double) { return false; };
  EXPECT_THROW(ComputeBlockShare(shape, weights, plan, 0, Engine::Lattice, no), Cancelled);
  const auto shares = testing::SharesOf(shape, weights, plan, Engine::Lattice);
  EXPECT_THROW(JoinBlockShares(
                 2,
                 [&](std::size_t i) { return shares[i]; },
                 no),
               Cancelled);
}

} // namespace
} // namespace voxelcore
