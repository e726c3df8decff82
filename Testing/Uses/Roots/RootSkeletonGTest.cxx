#include "RootScore.h"
#include "VoxelCoreTesting/SurfaceNoise.h"

#include "voxelcore/Masks/ShapeSmoothing.h"
#include "voxelcore/Skeleton/BranchTable.h"

#include <iostream>

namespace voxelcore::testing
{

namespace
{

TEST(RootSkeleton, HasTheTrueTipsLengthAndRadiusAndNoOtherTips)
{
  Score score;
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
  {
    CompareRoot(96, 1, seed, score);
    CompareRoot(96, 2, seed, score);
  }
  ASSERT_GT(score.expected, 50U);
  EXPECT_EQ(score.missed, 0U);
  EXPECT_LE(static_cast<double>(score.spurious), 0.02 * static_cast<double>(score.found));
  EXPECT_LE(score.worstLength, 0.03);
  EXPECT_LE(score.worstRadius, 0.5);
}

TEST(RootSkeleton, IsTheSameInAllRotationsOfTheGrid)
{
  for (const char * kind : { "root", "gyroid", "porous", "ellipsoid" })
  {
    SCOPED_TRACE(kind);
    const std::int32_t    n = std::string(kind) == "root" ? 96 : 24;
    const VoxelShape      shape = PhantomShape(kind, n, 2);
    const SkeletonNumbers expected = MeasureBranches(GraphOf(shape)).numbers;
    int                   rotations = 0;
    ForRotations(shape, n, [&](const VoxelShape & turned) {
      const SkeletonNumbers numbers = MeasureBranches(GraphOf(turned)).numbers;
      EXPECT_EQ(numbers.components, expected.components);
      EXPECT_EQ(numbers.cycles, expected.cycles);
      EXPECT_EQ(numbers.tips, expected.tips);
      EXPECT_EQ(numbers.junctions, expected.junctions);
      EXPECT_NEAR(numbers.totalLength, expected.totalLength, 1e-6 * expected.totalLength);
      ++rotations;
    });
    EXPECT_EQ(rotations, 24);
  }
}

/** Of 5 % noise on roots the thinnest of which are a voxel thick; with `simple` it keeps the topology, else it is
 *  mended. */
void
ExpectNoBranchesOfNoise(std::uint64_t seeds, bool simple)
{
  std::int64_t clean = 0;
  std::int64_t noisy = 0;
  std::int64_t torn = 0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed)
  {
    const VoxelShape shape = PhantomShape("root", 96, seed);
    const VoxelShape flipped = Flipped(shape, 96, seed, simple);
    const auto       branches = [](const VoxelShape & one) { return MeasureBranches(GraphOf(one)).numbers.branches; };
    clean += branches(shape);
    torn += branches(flipped);
    noisy += simple ? branches(flipped) : branches(SmoothShape(MendShape(flipped).shape).shape);
  }
  std::cout << clean << " branches, " << torn << " with noise, " << noisy << " in the end\n";
  EXPECT_GT(clean, static_cast<std::int64_t>(20 * seeds));
  EXPECT_NEAR(static_cast<double>(noisy), static_cast<double>(clean), 0.1 * static_cast<double>(clean));
}

TEST(RootSkeleton, HasTheSameBranchesWhenNoiseOfAnyKindIsMendedAndSmoothed)
{
  ExpectNoBranchesOfNoise(3, false);
}

TEST(HeavyRootSkeleton, NoiseOnTheSurfaceAddsNoBranches)
{
  ExpectNoBranchesOfNoise(10, true);
  ExpectNoBranchesOfNoise(10, false);
}

TEST(HeavyRootSkeleton, HasTheTrueTipsLengthAndRadiusOverSeedsAndResolutions)
{
  for (const double slice : { 1.0, 2.0 })
  {
    for (const std::int32_t size : { 96, 160, 256 })
    {
      Score score;
      for (std::uint64_t seed = 1; seed <= 20; ++seed)
      {
        CompareRoot(size, slice, seed, score);
      }
      std::cout << size << ", slices " << slice << ": " << score.expected << " true tips, " << score.missed
                << " missed, " << score.spurious << " of " << score.found << " spurious; length off by "
                << 5 * score.sumOfLengths << " % on average, " << 100 * score.worstLength
                << " % at worst; mean radius off by " << score.worstRadius << " voxels at worst\n";
      EXPECT_EQ(score.missed, 0U);
      EXPECT_LE(score.worstLength, 0.02);
      EXPECT_LE(score.worstRadius, 0.5);
      EXPECT_LE(static_cast<double>(score.spurious), 0.05 * static_cast<double>(score.found));
    }
  }
}

} // namespace

} // namespace voxelcore::testing
