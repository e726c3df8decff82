// The proof's promise on random volumes: the core and each pruned core have the shape's topology and lie inside it.

#include "VoxelCoreTesting/Cores.h"

#include "voxelcore/Complex/ComplexTopology.h"
#include "voxelcore/Shape/ShapeTopology.h"
#include "voxelcore/VoxelCore/LambdaPruning.h"

#include <gtest/gtest.h>

#include <iostream>

namespace voxelcore
{
namespace
{

void
ExpectCertificate(const testing::RandomVolume & volume)
{
  SCOPED_TRACE(volume.Describe());
  const SpacingWeights  weights = ComputeSpacingWeights(volume.spacing);
  const TopologyNumbers expected = ComputeShapeTopology(volume.shape);
  const MedialComplex   core = ComputeVoxelCore(volume.shape, weights);
  ASSERT_EQ(ComputeComplexTopology(core.cells), expected) << "the whole core";
  for (const auto & position : core.positions)
  {
    ASSERT_TRUE(testing::LiesInOpenShape(volume.shape, position))
      << position[0] << ' ' << position[1] << ' ' << position[2];
  }
  std::vector<double> thresholds;
  for (const char * text : { "1.5vox", "2.5vox" })
  {
    thresholds.push_back(LambdaInMillimetres(ParseLambda(text), weights, volume.spacing, volume.shape.Box()));
  }
  for (const MedialComplex & pruned : PruneByLambda(core, thresholds))
  {
    ASSERT_EQ(ComputeComplexTopology(pruned.cells), expected) << "a pruned core";
  }
}

void
ExpectCertificates(std::uint64_t firstSeed, std::uint64_t count, std::int32_t least, std::int32_t greatest)
{
  std::cout << "seeds " << firstSeed << " to " << firstSeed + count - 1 << '\n';
  for (std::uint64_t seed = firstSeed; seed < firstSeed + count; ++seed)
  {
    ExpectCertificate(testing::MakeRandomVolume(seed, least, greatest));
    if (::testing::Test::HasFatalFailure())
    {
      ::testing::Test::RecordProperty("seed", std::to_string(seed));
      return;
    }
  }
}

// 1,900 volumes in four parts, so that a test runner can use its cores.
TEST(Certificate, HoldsOnRandomVolumesPart1)
{
  ExpectCertificates(1, 475, 3, 12);
}

TEST(Certificate, HoldsOnRandomVolumesPart2)
{
  ExpectCertificates(476, 475, 3, 12);
}

TEST(Certificate, HoldsOnRandomVolumesPart3)
{
  ExpectCertificates(951, 475, 3, 12);
}

TEST(Certificate, HoldsOnRandomVolumesPart4)
{
  ExpectCertificates(1426, 475, 3, 12);
}

TEST(HeavyCertificate, HoldsOnLargerRandomVolumes)
{
  ExpectCertificates(100001, 100, 13, 40);
}

} // namespace
} // namespace voxelcore
