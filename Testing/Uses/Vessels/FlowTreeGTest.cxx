#include "MeasuredGraphs.h"

#include "voxelcore/Vessels/FlowTree.h"

#include <gtest/gtest.h>

namespace voxelcore::testing
{

TEST(FlowTree, LeadsOutwardsAlongTheThickestBranchesAndLeavesOutWhatClosesLoops)
{
  GraphOfLines       lines;
  const ElementIndex in = lines.Point({ 0, 0, 0 }, 2);
  const ElementIndex split = lines.Point({ 10, 0, 0 }, 2);
  const ElementIndex join = lines.Point({ 30, 0, 0 }, 2);
  const ElementIndex out = lines.Point({ 40, 0, 0 }, 1);
  const ElementIndex thin = lines.Point({ 20, 8, 0 }, 0.5);
  const ElementIndex thick = lines.Point({ 20, -12, 0 }, 3);
  lines.Line(in, split, 5);
  lines.Line(split, thin, 5);
  lines.Line(thin, join, 5);
  lines.Line(split, thick, 5);
  lines.Line(thick, join, 5);
  lines.Line(out, join, 5);
  const MeasuredSkeleton part = lines.Measured();
  const auto             inlets = FindInlets({ part }, { { { 0, 1, 0 } }, {} });
  const FlowTree         tree = DirectFlow(part, inlets[0]);
  ASSERT_EQ(part.graph.BranchCount(), 4U);
  ASSERT_EQ(tree.roots.size(), 1U);
  EXPECT_EQ(tree.order.size(), 4U);
  for (std::size_t branch = 0; branch < 4; ++branch)
  {
    const auto [first, last] = part.graph.branchNodes[branch];
    EXPECT_EQ(tree.isOnTree[branch] != 0,
              part.table.branches[branch].meanRadius > 1.4 || part.table.branches[branch].length < 11);
    EXPECT_EQ(tree.isForward[branch] != 0, tree.way[first] < tree.way[last]);
  }
  const auto nodeAt = [&](const Vector3 & place) {
    std::size_t node = 0;
    while (part.graph.positions[part.graph.nodePoints[node]] != place)
    {
      ++node;
    }
    return node;
  };
  EXPECT_EQ(tree.way[nodeAt({ 0, 0, 0 })], 0);
  EXPECT_NEAR(tree.way[nodeAt({ 40, 0, 0 })], 20 + 2 * std::sqrt(244.0), 1e-9);
}

TEST(FlowTree, InletsAreAtTheBorderWhereThereIsOne)
{
  GraphOfLines       lines;
  const ElementIndex fork = lines.Point({ 10, 10, 10 }, 2);
  lines.Line(lines.Point({ 10, 10, 2 }, 2), fork, 4);
  lines.Line(lines.Point({ 4, 10, 16 }, 1.5), fork, 4);
  lines.Line(lines.Point({ 19.5, 10, 18 }, 1), fork, 4);
  InletChoice choice;
  choice.geometry.size = { 20, 20, 20 };
  choice.border = VoxelBox{ { 0, 0, 0 }, { 20, 20, 20 } };
  const std::vector<MeasuredSkeleton> parts{ lines.Measured() };
  const auto                          place = [&] {
    const SkeletonGraph & graph = parts[0].graph;
    return graph.positions[graph.nodePoints[FindInlets(parts, choice)[0].at(0)]];
  };
  EXPECT_EQ(place()[0], 19.5);
  choice.border.reset();
  EXPECT_EQ(place()[2], 2);
}

} // namespace voxelcore::testing
