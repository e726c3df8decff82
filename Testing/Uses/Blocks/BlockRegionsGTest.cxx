// A block's share comes out the same from the voxels of its region alone, and plans survive a file.

#include "voxelcore/Blocks/BlockRegions.h"

#include "HaloBlocksFixture.h"
#include "Core/Delaunay/EngineFixture.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Shape/ShapeOperations.h"

#include <iostream>
#include <sstream>

namespace voxelcore
{
namespace
{

/** Order and triangulation of cells and facets are left to the engine. */
void
ExpectSameShare(const BlockShare & one, const BlockShare & other)
{
  EXPECT_EQ(one.digest, other.digest);
  EXPECT_TRUE(one.points == other.points);
  EXPECT_TRUE(one.isOwn == other.isOwn);
  EXPECT_EQ(one.cells.CellCount(), other.cells.CellCount());
  EXPECT_EQ(one.cells.FacetCount(), other.cells.FacetCount());
  EXPECT_EQ(one.cells.facetPoints.size(), other.cells.facetPoints.size());
}

void
ExpectSameShares(const VoxelShape & shape, const testing::Spacing3 & spacing, std::size_t count)
{
  SCOPED_TRACE(std::to_string(count) + " blocks");
  const testing::WholeShape whole(shape, spacing);
  const BlockPlan           plan = PlanBlocks(shape, whole.weights, count);
  const auto                regions = FindBlockRegions(shape, whole.weights, plan);
  std::vector<BlockShare>   shares;
  ASSERT_EQ(regions.size(), count);
  for (std::size_t block = 0; block < count; ++block)
  {
    const BlockRegion & region = regions[block];
    const VoxelShape    part = CropToBox(shape, region.box).shape;
    EXPECT_EQ(part.CountVoxels(), region.voxels);
    EXPECT_TRUE(IsRegionOf(region, part));
    EXPECT_TRUE(IsRegionOf(region, shape));
    shares.push_back(ComputeBlockShare(part, whole.weights, plan, region, block, Engine::Lattice));
    ExpectSameShare(shares.back(), ComputeBlockShare(shape, whole.weights, plan, block, Engine::Lattice));
  }
  whole.ExpectJoined(JoinBlockShares(shares));
}

/** A rod along x, of 5 x 6 voxels. */
VoxelShape
Rod(std::int32_t length)
{
  return testing::ShapeWhere({ length, 5, 6 }, [](int, int, int) { return true; });
}

TEST(BlockRegions, SharesOfTheRegionsAreThoseOfTheWhole)
{
  for (const testing::Spacing3 & spacing :
       { testing::Spacing3{ 1, 1, 1 }, testing::Spacing3{ 1, 1, 3 }, testing::Spacing3{ 2, 1, 1 } })
  {
    for (const std::size_t count : { 1, 2, 7, 16 })
    {
      ExpectSameShares(Rod(150), spacing, count);
      ExpectSameShares(testing::ShapeWhere({ 30, 28, 26 },
                                           [](int x, int y, int z) {
                                             const auto square = [](int at) { return (at - 13) * (at - 13); };
                                             return square(x) + square(y) + square(z) < 150;
                                           }),
                       spacing,
                       count);
    }
  }
}

TEST(BlockRegions, SharesOfRandomVolumesAreThoseOfTheWhole)
{
  std::cout << "seeds 1 to 60\n";
  for (std::uint64_t seed = 1; seed <= 60; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const testing::RandomVolume volume = testing::MakeRandomVolume(seed, 4, 24);
    ExpectSameShares(volume.shape, volume.spacing, 1 + seed % 9);
  }
}

TEST(BlockRegions, AreSmallWhereTheShapeIsThin)
{
  const VoxelShape     rod = Rod(800);
  const SpacingWeights weights = ComputeSpacingWeights({ 1, 1, 1 });
  for (const BlockRegion & region : FindBlockRegions(rod, weights, PlanBlocks(rod, weights, 8)))
  {
    EXPECT_GE(region.box.size[0], 100);
    EXPECT_LE(region.box.size[0], 110) << "a rod's balls reach three voxels and a half";
  }
}

TEST(BlockRegions, OtherVoxelsAreRefused)
{
  const VoxelShape     rod = Rod(100);
  const SpacingWeights weights = ComputeSpacingWeights({ 1, 1, 1 });
  const BlockPlan      plan = PlanBlocks(rod, weights, 4);
  const auto           regions = FindBlockRegions(rod, weights, plan);
  VoxelShape           less = CropToBox(rod, regions[1].box).shape;
  less.Row(0, 0)[0] &= ~std::uint64_t{ 1 };
  EXPECT_FALSE(IsRegionOf(regions[1], less));
  EXPECT_THROW(ComputeBlockShare(less, weights, plan, regions[1], 1), InputError);
  EXPECT_THROW(ComputeBlockShare(rod, ComputeSpacingWeights({ 1, 1, 2 }), plan, regions[1], 1), InputError);
  EXPECT_THROW(ComputeBlockShare(rod, weights, plan, regions[1], 4), UsageError);
}

TEST(ScanPlan, ComesBackFromItsFileUnlessThatIsDamaged)
{
  const VoxelShape     rod = Rod(100);
  const SpacingWeights weights = ComputeSpacingWeights({ 1, 2, 1 });
  const BlockPlan      plan = PlanBlocks(rod, weights, 5);
  const ScanPlan       written{ "a scan", { { -3, "rod", plan, FindBlockRegions(rod, weights, plan) } } };
  std::ostringstream   stream;
  WriteScanPlan(written, stream);
  const std::string bytes = stream.str();
  const auto        read = [](const std::string & text) {
    std::istringstream from(text);
    return ReadScanPlan(from, "a.vcp");
  };
  const ScanPlan again = read(bytes);
  EXPECT_EQ(again.source, "a scan");
  ASSERT_EQ(again.labels.size(), 1U);
  EXPECT_EQ(again.labels[0].value, -3);
  EXPECT_EQ(again.labels[0].name, "rod");
  EXPECT_TRUE(IsPlanOf(again.labels[0].plan, rod, weights));
  EXPECT_TRUE(again.labels[0].plan.blocks == plan.blocks);
  EXPECT_EQ(again.labels[0].plan.boundaryVertices, plan.boundaryVertices);
  EXPECT_TRUE(again.labels[0].regions == written.labels[0].regions);
  for (std::size_t at = 0; at < bytes.size(); ++at)
  {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    EXPECT_THROW(read(damaged), InputError) << "byte " << at;
    EXPECT_THROW(read(bytes.substr(0, at)), InputError) << "cut at " << at;
  }
  EXPECT_THROW(read(bytes + "x"), InputError);
}

} // namespace
} // namespace voxelcore
