#pragma once
// Shares of test shapes, and what it means that their join is the whole.

#include "Core/Delaunay/SameCells.h"

#include "voxelcore/Blocks/HaloBlocks.h"
#include "voxelcore/Shape/ShapeTopology.h"

#include <gtest/gtest.h>

namespace voxelcore::testing
{

inline std::vector<BlockShare>
SharesOf(const VoxelShape & shape, const SpacingWeights & weights, const BlockPlan & plan, Engine engine)
{
  std::vector<BlockShare> shares;
  for (std::size_t block = 0; block < plan.blocks.size(); ++block)
  {
    shares.push_back(ComputeBlockShare(shape, weights, plan, block, engine));
  }
  return shares;
}

/** A shape computed at once, to compare with. */
struct WholeShape
{
  VoxelShape                shape;
  SpacingWeights            weights;
  Engine                    engine;
  std::vector<LatticePoint> points;
  DelaunayCells             cells;

  explicit WholeShape(VoxelShape itsShape, const Spacing3 & spacing = { 1, 1, 1 }, Engine itsEngine = Engine::Lattice)
    : shape(std::move(itsShape))
    , weights(ComputeSpacingWeights(spacing))
    , engine(itsEngine)
    , points(BoundaryVertices(shape))
    , cells(ComputeDelaunayCells(shape, points, weights, engine))
  {}

  void
  ExpectJoined(const JoinedCells & joined) const
  {
    ASSERT_TRUE(joined.points == points);
    ASSERT_NO_FATAL_FAILURE(ExpectSameCells(joined.cells, cells));
    const TopologyNumbers numbers = ComputeShapeTopology(shape);
    EXPECT_EQ(joined.topology.euler, numbers.euler);
    EXPECT_EQ(joined.topology.betti, numbers.betti);
  }

  void
  ExpectJoinOf(const BlockPlan & plan) const
  {
    ASSERT_NO_FATAL_FAILURE(ExpectJoined(JoinBlockShares(SharesOf(shape, weights, plan, engine))));
  }

  void
  ExpectJoinOf(const std::vector<std::size_t> & counts) const
  {
    for (const std::size_t count : counts)
    {
      SCOPED_TRACE(std::to_string(count) + " blocks");
      ASSERT_NO_FATAL_FAILURE(ExpectJoinOf(PlanBlocks(shape, weights, count)));
    }
  }
};

} // namespace voxelcore::testing
