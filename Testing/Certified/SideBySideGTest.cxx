// Shapes so large that every loop shares its work out: the same bits as on one thread, and progress from one thread at
// a time. What threads do to each other ThreadSanitizer says.

#include "CertifiedFixtures.h"

#include "VoxelCoreTesting/Cores.h"
#include "VoxelCoreTesting/Threads.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

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
  ImageGeometry   geometry = Grid({ 1, 1, 1.5 });
  CertifiedResult result = ComputeCertified(Labyrinth(), geometry, request, progress);
  EXPECT_GT(calls, 0);
  EXPECT_FALSE(overlapped);
  return result;
}

void
ExpectSameOnThreads(const CertifiedRequest & request)
{
  const CertifiedResult alone = Compute(request, 1);
  const CertifiedResult together = Compute(request, 4);
  ASSERT_GT(alone.boundaryVertices, 10000U);
  ASSERT_EQ(alone.cores.size(), together.cores.size());
  for (std::size_t i = 0; i < alone.cores.size(); ++i)
  {
    const PlacedCore & one = alone.cores[i].core;
    const PlacedCore & other = together.cores[i].core;
    ASSERT_GT(one.core.cells.FaceCount(), 0U);
    testing::ExpectSameCore(one.core, other.core);
    EXPECT_EQ(one.displacement, other.displacement);
    EXPECT_EQ(one.radiusMargin, other.radiusMargin);
  }
  ASSERT_EQ(alone.skeleton.has_value(), together.skeleton.has_value());
  if (alone.skeleton)
  {
    const SkeletonGraph & one = alone.skeleton->skeleton.graph;
    const SkeletonGraph & other = together.skeleton->skeleton.graph;
    ASSERT_GT(one.BranchCount(), 10U);
    EXPECT_EQ(one.positions, other.positions);
    EXPECT_EQ(one.radius, other.radius);
    EXPECT_EQ(one.sectionRadius, other.sectionRadius);
    EXPECT_EQ(one.erosionThickness, other.erosionThickness);
    EXPECT_EQ(one.branchPoints, other.branchPoints);
  }
  ASSERT_EQ(alone.thickness.has_value(), together.thickness.has_value());
  if (alone.thickness)
  {
    EXPECT_EQ(alone.thickness->map.values, together.thickness->map.values);
    EXPECT_EQ(alone.thickness->bracket.upper.values, together.thickness->bracket.upper.values);
  }
}

TEST(SideBySide, RefinedCoresAndTheirSkeletonAreTheSameOnSeveralThreads)
{
  CertifiedRequest request; // by tolerance, refined
  request.skeleton = Skeleton();
  ExpectSameOnThreads(request);
}

TEST(SideBySide, ExactCoresAndThicknessAreTheSameOnSeveralThreads)
{
  CertifiedRequest request = Lambdas({ "0", "1vox" });
  request.skeleton = Skeleton();
  request.thickness = ThicknessRequest{ true };
  ExpectSameOnThreads(request);
}

} // namespace
} // namespace voxelcore
