// Memory that runs out within a parallel loop is thrown on (Testing/Scans/Masks/LackOfMemoryGTest.cxx).

#include "VoxelCoreTesting/FailingMemory.h"
#include "VoxelCoreTesting/Shapes.h"
#include "VoxelCoreTesting/Threads.h"

#include "voxelcore/Verification/BallCoverage.h"
#include "voxelcore/VoxelCore/BallUnion.h"

#ifdef VOXELCORE_FAILING_MEMORY

namespace voxelcore::testing
{
namespace
{

TEST(LackOfMemory, WithinAParallelLoopOverBallsIsThrownOn)
{
  const Threads                            scope(3);
  const std::vector<std::array<double, 3>> centres{ { 20, 20, 10 }, { 20, 20, 50 } };
  const std::vector<double>                radius{ 9, 9 };
  const VoxelShape                         ellipsoid = Ellipsoid(64);
  ExpectLackOfMemoryIsThrownOn({
    { "balls",
      [&] {
        UnionOfBalls(VoxelBox{ { 0, 0, 0 }, { 40, 40, 64 } }, { 1, 1, 1 }, centres, radius);
      } },
    { "coverage", [&] { LargestBoundaryGap(ellipsoid, SpacingWeights{}, centres, radius); } },
  });
}

} // namespace
} // namespace voxelcore::testing

#endif
