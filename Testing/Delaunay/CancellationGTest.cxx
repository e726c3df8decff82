// Whoever waits for an engine can stop waiting. (TetGen itself cannot be interrupted and is left to finish.)

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

// What each engine needs seconds for: noise costs TetGen most, a fat solid the one made for voxels.
VoxelShape
LargeShape(Engine engine)
{
  testing::Random random(12);
  return engine == Engine::TetGen ? testing::RandomShape(random, { 48, 48, 48 }, 0.5) : testing::Ellipsoid(320);
}

class CancellationOf : public ::testing::TestWithParam<Engine>
{
protected:
  void
  SetUp() override
  {
    if (!HasEngine(GetParam()))
    {
      GTEST_SKIP() << "this build lacks the engine";
    }
  }
};

INSTANTIATE_TEST_SUITE_P(Engines,
                         CancellationOf,
                         ::testing::Values(Engine::Lattice, Engine::TetGen),
                         [](const auto & engine) { return engine.param == Engine::Lattice ? "Lattice" : "TetGen"; });

TEST_P(CancellationOf, ComesThroughWithinASecondAndLeavesTheEngineUsable)
{
  testing::Random      random(13);
  const VoxelShape     large = LargeShape(GetParam());
  const auto           largePoints = BoundaryVertices(large);
  const VoxelShape     small = testing::RandomShape(random, { 8, 8, 8 }, 0.5);
  const auto           smallPoints = BoundaryVertices(small);
  const SpacingWeights weights;
  const DelaunayCells  before = ComputeDelaunayCells(small, smallPoints, weights, GetParam());

  // Someone presses a key a quarter of a second after the start; what counts is how soon that is noticed.
  const auto start = Clock::now();
  const auto stopSoon = [&](std::string_view, double) { return SecondsSince(start) < 0.25; };
  EXPECT_THROW(ComputeDelaunayCells(large, largePoints, weights, GetParam(), stopSoon), Cancelled);
  EXPECT_GE(SecondsSince(start), 0.25) << "the large shape was done before it could be cancelled";
  EXPECT_LT(SecondsSince(start), 1.25);

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
