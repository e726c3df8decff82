#include "SkeletonFixtures.h"

#include "voxelcore/Skeleton/MeasuredSkeleton.h"

#include <iostream>

namespace voxelcore::testing
{
namespace
{

/** Every row of the table is that of the branch in its place. */
void
ExpectTableOfGraph(const MeasuredSkeleton & skeleton)
{
  const SkeletonGraph & graph = skeleton.graph;
  ASSERT_EQ(skeleton.table.branches.size(), graph.BranchCount());
  double total = 0;
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    const BranchRecord & row = skeleton.table.branches[branch];
    const auto           points = graph.Branch(branch);
    ASSERT_DOUBLE_EQ(row.length, graph.BranchLength(branch)) << "branch " << branch;
    ASSERT_DOUBLE_EQ(row.chord, Distance(graph.positions[points.front()], graph.positions[points.back()]));
    int tips = 0;
    for (const ElementIndex node : graph.branchNodes[branch])
    {
      tips += graph.nodeKinds[node] == NodeKind::Tip ? 1 : 0;
    }
    const bool closed = points.front() == points.back();
    ASSERT_EQ(row.type,
              closed      ? BranchType::Cycle
              : tips == 2 ? BranchType::TipToTip
              : tips == 1 ? BranchType::TipToJunction
                          : BranchType::JunctionToJunction)
      << "branch " << branch;
    total += row.length;
  }
  ASSERT_NEAR(skeleton.table.numbers.totalLength, total, 1e-9 * (1 + total));
  std::int64_t tips = 0;
  std::int64_t isolated = 0;
  for (const NodeKind kind : graph.nodeKinds)
  {
    tips += kind == NodeKind::Tip ? 1 : 0;
    isolated += kind == NodeKind::Isolated ? 1 : 0;
  }
  ASSERT_EQ(skeleton.table.numbers.tips, tips);
  ASSERT_EQ(skeleton.table.numbers.isolatedPoints, isolated);
}

TEST(MeasuredSkeleton, TheTableHasARowForEachBranchInItsPlaceAlsoAfterEdits)
{
  constexpr std::uint64_t firstSeed = 3300;
  std::cout << "seeds from " << firstSeed << '\n';
  std::size_t branches = 0;
  for (std::uint64_t seed = firstSeed; seed < firstSeed + 40; ++seed)
  {
    const RandomVolume volume = MakeRandomVolume(seed, 3, 9);
    SCOPED_TRACE(volume.Describe());
    MeasuredSkeleton skeleton;
    skeleton.graph = BuildSkeletonGraph(SkeletonOf(SurfaceOf(volume.shape, volume.spacing), 0));
    const auto measure = [&] {
      skeleton.table = MeasureBranches(skeleton.graph);
      ASSERT_NO_FATAL_FAILURE(ExpectTableOfGraph(skeleton));
    };
    measure();
    branches += skeleton.graph.BranchCount();
    PruneBranches(skeleton.graph, { 1.5, 0 });
    measure();
    CutLoops(skeleton.graph);
    measure();
    SplitAtJunctions(skeleton.graph);
    measure();
  }
  EXPECT_GT(branches, 500U);
}

} // namespace
} // namespace voxelcore::testing
