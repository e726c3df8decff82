// Shapes so large that every loop shares its work out: the same bits as on one thread, and progress from one thread at
// a time. What threads do to each other ThreadSanitizer says.

#include "CertifiedFixtures.h"

#include "VoxelCoreTesting/Cores.h"
#include "VoxelCoreTesting/Threads.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string_view>

namespace voxelcore
{
namespace
{

/** A gyroid with holes, of some 17,000 boundary vertices. */
VoxelShape
Labyrinth()
{
  constexpr int    side = 40;
  constexpr double period = 16;
  return testing::ShapeWhere({ side, side, side }, [](int x, int y, int z) {
    const auto wave = [](int at) { return 2 * std::numbers::pi * at / period; };
    const auto product = [&](int a, int b) { return std::sin(wave(a)) * std::cos(wave(b)); };
    return product(x, y) + product(y, z) + product(z, x) > 0 && (7 * x + 11 * y + 13 * z) % 199 != 0;
  });
}

CertifiedResult
Compute(const CertifiedRequest & request, int threads)
{
  const testing::Threads scope(threads);
  // Not atomic: the calls come one after the other.
  int                    calls = 0;
  bool                   isWithin = false;
  bool                   overlapped = false;
  const ProgressCallback progress = [&](std::string_view, double) {
    overlapped = overlapped || isWithin;
    isWithin = true;
    ++calls;
    isWithin = false;
    return true;
  };
  const ImageGeometry geometry = Grid({ 1, 1, 1.5 });
  CertifiedResult     result = ComputeCertified(Labyrinth(), geometry, request, progress);
  EXPECT_GT(calls, 0);
  EXPECT_FALSE(overlapped);
  return result;
}

TEST(SideBySide, RefinedCoresAndTheirSkeletonAreTheSameOnSeveralThreads)
{
  CertifiedRequest request; // by tolerance, refined
  request.skeleton = Skeleton();
  const CertifiedResult alone = Compute(request, 1);
  const CertifiedResult together = Compute(request, 4);
  ASSERT_GT(alone.boundaryVertices, 10000U);
  ASSERT_EQ(alone.cores.size(), 1U);
  ASSERT_EQ(together.cores.size(), 1U);
  const PlacedCore & core = alone.cores.front().core;
  ASSERT_GT(core.core.cells.FaceCount(), 0U);
  testing::ExpectSameCore(core.core, together.cores.front().core.core);
  EXPECT_EQ(core.displacement, together.cores.front().core.displacement);
  EXPECT_EQ(core.radiusMargin, together.cores.front().core.radiusMargin);
  ASSERT_TRUE(alone.skeleton && together.skeleton);
  const SkeletonGraph & graph = alone.skeleton->skeleton.graph;
  const SkeletonGraph & other = together.skeleton->skeleton.graph;
  ASSERT_GT(graph.BranchCount(), 10U);
  EXPECT_EQ(graph.positions, other.positions);
  EXPECT_EQ(graph.radius, other.radius);
  EXPECT_EQ(graph.sectionRadius, other.sectionRadius);
  EXPECT_EQ(graph.erosionThickness, other.erosionThickness);
  EXPECT_EQ(graph.branchPoints, other.branchPoints);
}

} // namespace
} // namespace voxelcore
