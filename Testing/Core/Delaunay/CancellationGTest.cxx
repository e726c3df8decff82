// Whoever waits for an engine can stop waiting. (TetGen itself cannot be interrupted and is left to finish.)

#include "EngineFixture.h"

#include "VoxelCoreTesting/Shapes.h"

#include "voxelcore/Delaunay/DelaunayCells.h"
#include "voxelcore/Shape/BoundaryVertices.h"

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

// What each engine works on for a while: noise costs TetGen most, a fat solid the one made for voxels.
VoxelShape
LargeShape(Engine engine)
{
  testing::Random random(12);
  return engine == Engine::TetGen ? testing::RandomShape(random, { 48, 48, 48 }, 0.5) : testing::Ellipsoid(256);
}

class CancellationOf : public testing::WithEngine
{};

INSTANTIATE_TEST_SUITE_P(Engines, CancellationOf, testing::AllEngines(), testing::EngineName);

TEST_P(CancellationOf, ComesThroughWithinASecondAndLeavesTheEngineUsable)
{
  testing::Random      random(13);
  const VoxelShape     large = LargeShape(GetParam());
  const auto           largePoints = BoundaryVertices(large);
  const VoxelShape     small = testing::RandomShape(random, { 8, 8, 8 }, 0.5);
  const auto           smallPoints = BoundaryVertices(small);
  const SpacingWeights weights;
  const DelaunayCells  before = ComputeDelaunayCells(small, smallPoints, weights, GetParam());

  // At the third question, so that the engine is at work; what counts is how soon the answer is heeded.
  Clock::time_point stopped;
  int               calls = 0;
  const auto        stopAtTheThird = [&](std::string_view, double) {
    stopped = Clock::now();
    return ++calls < 3;
  };
  EXPECT_THROW(ComputeDelaunayCells(large, largePoints, weights, GetParam(), stopAtTheThird), Cancelled);
  ASSERT_GE(calls, 3) << "the large shape was done before it could be cancelled";
  EXPECT_LT(SecondsSince(stopped), 1.0);

  // TetGen: waits for its turn behind the abandoned run, and is not disturbed by it.
  const DelaunayCells after = ComputeDelaunayCells(small, smallPoints, weights, GetParam());
  EXPECT_EQ(after.centres, before.centres);
  EXPECT_EQ(after.facetCells, before.facetCells);
  EXPECT_EQ(after.facetOffsets, before.facetOffsets);
  EXPECT_EQ(after.facetPoints, before.facetPoints);
}

TEST_P(CancellationOf, BeforeTheStartNeedsNoEngine)
{
  const VoxelShape shape = testing::Box({ 3, 3, 3 });
  EXPECT_THROW(ComputeDelaunayCells(shape,
                                    BoundaryVertices(shape),
                                    SpacingWeights{},
                                    GetParam(),
                                    [](std::string_view, double) { return false; }),
               Cancelled);
}

TEST_P(CancellationOf, ProgressRunsFromNothingToAll)
{
  std::vector<double> fractions;
  const VoxelShape    shape = testing::Ellipsoid(64);
  ComputeDelaunayCells(shape,
                       BoundaryVertices(shape),
                       SpacingWeights{},
                       GetParam(),
                       [&](std::string_view stage, double fraction) {
                         EXPECT_EQ(stage, "delaunay");
                         fractions.push_back(fraction);
                         return true;
                       });
  ASSERT_GE(fractions.size(), 2U);
  EXPECT_EQ(fractions.front(), 0.0);
  EXPECT_EQ(fractions.back(), 1.0);
  for (const double fraction : fractions)
  {
    EXPECT_GE(fraction, 0.0);
    EXPECT_LE(fraction, 1.0);
  }
}

} // namespace
} // namespace voxelcore
