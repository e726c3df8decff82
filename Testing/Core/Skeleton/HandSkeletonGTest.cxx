// The skeleton of a hand.

#include "HandShape.h"

#include "voxelcore/Shape/ShapeTopology.h"
#include "voxelcore/Skeleton/BranchTable.h"

#include <iostream>

namespace voxelcore::testing
{

namespace
{

/** A tip at each of the ends and no loop; the number of tips beyond those six. */
std::int64_t
CountOtherTips(double scale, double about, double tilt)
{
  SCOPED_TRACE("scale " + std::to_string(scale) + ", turned by " + std::to_string(about) + " and " +
               std::to_string(tilt));
  std::vector<Spacing3> ends;
  const VoxelShape      shape = Voxels(MakeHand(), scale, about, tilt, ends);
  EXPECT_EQ(ComputeShapeTopology(shape).betti, (std::array<std::int64_t, 3>{ 1, 0, 0 }));
  const SkeletonGraph   graph = GraphOf(shape);
  const SkeletonNumbers numbers = MeasureBranches(graph).numbers;
  EXPECT_EQ(numbers.components, 1);
  EXPECT_EQ(numbers.cycles, 0);
  for (const Spacing3 & end : ends)
  {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t node = 0; node < graph.nodePoints.size(); ++node)
    {
      if (graph.nodeKinds[node] == NodeKind::Tip)
      {
        nearest = std::min(nearest, Distance(graph.positions[graph.nodePoints[node]], end));
      }
    }
    EXPECT_LE(nearest, 3 + 3 * scale) << "from an end at " << end[0] << ", " << end[1] << ", " << end[2];
  }
  return numbers.tips - static_cast<std::int64_t>(ends.size());
}

TEST(HandSkeleton, HasFiveFingersAndAWrist)
{
  EXPECT_EQ(CountOtherTips(0.4, 0, 0), 0);
  EXPECT_EQ(CountOtherTips(0.4, 0.7, 0.5), 0);
}

// Where the palm goes over into a finger the sheet has a corner; in large hands one of them may stand out enough.
TEST(HeavyHandSkeleton, MissesNoFingerAtAnyAngleOrSizeAndAddsOneAtMost)
{
  int exact = 0;
  for (const double scale : { 0.4, 0.6, 0.9 })
  {
    for (int turn = 0; turn < 4; ++turn)
    {
      const std::int64_t others = CountOtherTips(scale, 0.9 * turn, 0.55 * turn);
      EXPECT_LE(others, 1);
      exact += others == 0 ? 1 : 0;
    }
  }
  std::cout << exact << " of 12 hands have six tips\n";
  EXPECT_GE(exact, 9);
}

} // namespace

} // namespace voxelcore::testing
