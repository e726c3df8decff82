// TetGen cannot be interrupted; whoever waits for it can.

#include "VoxelCoreTesting/Shapes.h"

#include "voxelcore/BoundaryVertices.h"
#include "voxelcore/DelaunayCells.h"

#include <gtest/gtest.h>

#include <chrono>

namespace voxelcore
{
namespace
{

using Clock = std::chrono::steady_clock;

double
SecondsSince(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

TEST(Cancellation, ComesThroughWithinASecondAndLeavesTheEngineUsable)
{
  testing::Random      random(12);
  const VoxelShape     large = testing::RandomShape(random, { 48, 48, 48 }, 0.5);
  const auto           largePoints = BoundaryVertices(large);
  const VoxelShape     small = testing::RandomShape(random, { 8, 8, 8 }, 0.5);
  const auto           smallPoints = BoundaryVertices(small);
  const SpacingWeights weights;
  const DelaunayCells  before = ComputeDelaunayCells(small, smallPoints, weights, Engine::Auto);

  Clock::time_point asked;
  int               calls = 0;
  const auto        stopAtTheFourth = [&](std::string_view, double) {
    if (++calls == 4)
    {
      asked = Clock::now();
    }
    return calls < 4;
  };
  EXPECT_THROW(ComputeDelaunayCells(large, largePoints, weights, Engine::Auto, stopAtTheFourth), Cancelled);
  ASSERT_EQ(calls, 4) << "the large shape was done before it could be cancelled";
  EXPECT_LT(SecondsSince(asked), 1.0);

  // Waits for its turn behind the abandoned run, and is not disturbed by it.
  const DelaunayCells after = ComputeDelaunayCells(small, smallPoints, weights, Engine::Auto);
  EXPECT_EQ(after.centres, before.centres);
  EXPECT_EQ(after.facetCells, before.facetCells);
  EXPECT_EQ(after.facetOffsets, before.facetOffsets);
  EXPECT_EQ(after.facetPoints, before.facetPoints);
}

TEST(Cancellation, BeforeTheStartNeedsNoEngine)
{
  const VoxelShape shape = testing::Box({ 3, 3, 3 });
  EXPECT_THROW(ComputeDelaunayCells(shape,
                                    BoundaryVertices(shape),
                                    SpacingWeights{},
                                    Engine::Auto,
                                    [](std::string_view, double) { return false; }),
               Cancelled);
}

TEST(Progress, RunsFromNothingToAll)
{
  std::vector<double> fractions;
  const VoxelShape    shape = testing::Ellipsoid(24);
  ComputeDelaunayCells(shape,
                       BoundaryVertices(shape),
                       SpacingWeights{},
                       Engine::Auto,
                       [&](std::string_view stage, double fraction) {
                         EXPECT_EQ(stage, "delaunay");
                         fractions.push_back(fraction);
                         return true;
                       });
  ASSERT_GE(fractions.size(), 2U);
  EXPECT_EQ(fractions.front(), 0.0);
  EXPECT_EQ(fractions.back(), 1.0);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
}

} // namespace
} // namespace voxelcore
