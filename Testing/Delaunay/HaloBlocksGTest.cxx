// The cells of a shape computed block by block and joined are those of one run, to the last bit.

#include "voxelcore/HaloBlocks.h"

#include "EngineFixture.h"

#include "VoxelCoreTesting/Shapes.h"

#include "voxelcore/BoundaryVertices.h"
#include "voxelcore/Error.h"
#include "voxelcore/Predicates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <set>
#include <sstream>

namespace voxelcore
{
namespace
{

using testing::RandomVolume;
using testing::ShapeWhere;

std::vector<BlockShare>
AllShares(const VoxelShape & shape, const SpacingWeights & weights, std::size_t count, Engine engine = Engine::Lattice)
{
  const BlockPlan         plan = PlanBlocks(shape, weights, count);
  std::vector<BlockShare> shares;
  for (std::size_t block = 0; block < count; ++block)
  {
    shares.push_back(ComputeBlockShare(shape, weights, plan, block, engine));
  }
  return shares;
}

// Compared as wholes: millions of numbers in a failure help nobody.
void
ExpectSame(const JoinedCells & joined, const std::vector<LatticePoint> & points, const DelaunayCells & whole)
{
  ASSERT_TRUE(joined.points == points);
  ASSERT_EQ(joined.cells.CellCount(), whole.CellCount());
  ASSERT_EQ(joined.cells.FacetCount(), whole.FacetCount());
  ASSERT_TRUE(joined.cells.centres == whole.centres);
  ASSERT_TRUE(joined.cells.facetCells == whole.facetCells);
  ASSERT_TRUE(joined.cells.facetOffsets == whole.facetOffsets);
  ASSERT_TRUE(joined.cells.facetPoints == whole.facetPoints);
}

void
ExpectJoinIsWhole(const VoxelShape &               shape,
                  const testing::Spacing3 &        spacing,
                  const std::vector<std::size_t> & counts = { 1, 2, 3, 8 },
                  Engine                           engine = Engine::Lattice)
{
  const SpacingWeights weights = ComputeSpacingWeights(spacing);
  const auto           points = BoundaryVertices(shape);
  const DelaunayCells  whole = ComputeDelaunayCells(shape, points, weights, engine);
  for (const std::size_t count : counts)
  {
    SCOPED_TRACE(count);
    ASSERT_NO_FATAL_FAILURE(ExpectSame(JoinBlockShares(AllShares(shape, weights, count, engine)), points, whole));
  }
}

TEST(HaloBlocks, JoinOfRandomVolumesIsTheWhole)
{
  std::cout << "seeds from 40000\n";
  for (std::uint64_t seed = 40000; seed < 40300; ++seed)
  {
    const RandomVolume volume = testing::MakeRandomVolume(seed, 1, 20);
    SCOPED_TRACE(volume.Describe());
    ASSERT_NO_FATAL_FAILURE(ExpectJoinIsWhole(volume.shape, volume.spacing));
  }
}

} // namespace
} // namespace voxelcore
