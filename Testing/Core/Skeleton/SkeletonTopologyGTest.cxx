#include "SkeletonFixtures.h"

namespace voxelcore::testing
{

namespace
{

/** Skeletons at several thresholds have the surface's topology, and a face only where none can go. */
void
ExpectSameTopology(const MedialComplex & surface, double unit, const std::string & what)
{
  const TopologyNumbers expected = ComputeComplexTopology(surface.cells);
  const double          infinity = std::numeric_limits<double>::infinity();
  for (const auto & [branches, plates] : { std::pair<double, double>{ 0.0, infinity },
                                           { 1.0, infinity },
                                           { 3.0, infinity },
                                           { infinity, infinity },
                                           { 2.0, 0.5 },
                                           { infinity, 1.0 } })
  {
    const CurveSkeleton   skeleton = SkeletonOf(surface, branches * unit, plates * unit);
    const TopologyNumbers numbers = ComputeComplexTopology(skeleton.complex.cells);
    ASSERT_EQ(numbers.euler, expected.euler) << what << ", thresholds " << branches << ", " << plates;
    ASSERT_EQ(numbers.betti, expected.betti) << what << ", thresholds " << branches << ", " << plates;
    if (plates == infinity)
    {
      ASSERT_EQ(skeleton.ClosedFaceCount(), skeleton.complex.cells.FaceCount()) << what;
      ASSERT_TRUE(expected.betti[2] > 0 || skeleton.ClosedFaceCount() == 0) << what;
    }
    if (branches == infinity && expected.betti[1] == 0 && expected.betti[2] == 0 && plates == infinity)
    {
      ASSERT_EQ(skeleton.complex.cells.vertexCount, static_cast<std::size_t>(expected.betti[0])) << what;
    }
  }
}

void
CheckRandomVolumes(std::uint64_t first, std::uint64_t last, std::int32_t greatest)
{
  for (std::uint64_t seed = first; seed <= last; ++seed)
  {
    const RandomVolume volume = MakeRandomVolume(seed, 1, greatest);
    const double       unit = std::min({ volume.spacing[0], volume.spacing[1], volume.spacing[2] });
    ASSERT_NO_FATAL_FAILURE(ExpectSameTopology(SurfaceOf(volume.shape, volume.spacing), unit, volume.Describe()));
  }
}

void
CheckPhantoms(const std::vector<std::string> & kinds, std::int32_t size, std::uint64_t seeds)
{
  for (const std::string & kind : kinds)
  {
    for (std::uint64_t seed = 1; seed <= seeds; ++seed)
    {
      const VoxelShape shape = PhantomShape(kind, size, seed);
      for (const double lambda : { 0.0, 1.5 })
      {
        ASSERT_NO_FATAL_FAILURE(ExpectSameTopology(SurfaceOf(shape, { 1, 1, 1 }, lambda),
                                                   1,
                                                   kind + " of size " + std::to_string(size) + ", seed " +
                                                     std::to_string(seed) + ", lambda " + std::to_string(lambda)));
      }
    }
  }
}

TEST(SkeletonTopology, IsThatOfRandomVolumes)
{
  CheckRandomVolumes(1, 120, 9);
}

TEST(SkeletonTopology, IsThatOfPorousVolumesAndNoise)
{
  CheckPhantoms({ "porous", "noise" }, 20, 4);
}

TEST(SkeletonTopology, IsThatOfSolids)
{
  CheckPhantoms({ "torus", "tanglecube", "gyroid", "ellipsoid" }, 32, 1);
}

TEST(HeavySkeletonTopology, IsThatOfAThousandRandomAndPorousVolumes)
{
  CheckRandomVolumes(1000, 1799, 14);
  CheckPhantoms({ "porous", "noise" }, 32, 100);
}

} // namespace

} // namespace voxelcore::testing
