// The whole core of tiny shapes against its definition.

#include "VoxelCoreTesting/BruteCore.h"
#include "VoxelCoreTesting/Cores.h"

#include <gtest/gtest.h>

#include <iostream>

namespace voxelcore
{
namespace
{

using testing::BigRational;
using testing::IsNearestDouble;

// The double nearest to an exact number, by asking its neighbours.
double
Nearest(const BigRational & exact)
{
  double value = static_cast<double>(exact);
  for (const double candidate : { value, std::nextafter(value, HUGE_VAL), std::nextafter(value, -HUGE_VAL) })
  {
    if (IsNearestDouble(candidate, exact))
    {
      return candidate;
    }
  }
  ADD_FAILURE() << "the reference does not round " << exact;
  return value;
}

void
ExpectEqualsDefinition(const testing::RandomVolume & volume)
{
  SCOPED_TRACE(volume.Describe());
  const SpacingWeights     weights = ComputeSpacingWeights(volume.spacing);
  const MedialComplex      core = ComputeVoxelCore(volume.shape, weights);
  const testing::BruteCore brute = testing::MakeBruteCore(volume.shape, weights);
  const auto measure = [&](const BigRational & squared) { return std::sqrt(Nearest(squared)) * weights.unit; };

  ASSERT_EQ(core.cells.vertexCount, brute.centres.size());
  for (std::size_t v = 0; v < brute.centres.size(); ++v)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      ASSERT_EQ(core.positions[v][axis], Nearest(brute.centres[v][axis])) << "vertex " << v;
    }
    ASSERT_EQ(core.radius[v], measure(brute.squaredRadius[v])) << "vertex " << v;
    ASSERT_EQ(core.vertexLambda[v], measure(brute.squaredMeasure[v])) << "vertex " << v;
  }
  ASSERT_EQ(core.cells.edges.size(), brute.edges.size());
  std::size_t edge = 0;
  for (const auto & [ends, squared] : brute.edges)
  {
    ASSERT_EQ(core.cells.edges[edge], (std::array<ElementIndex, 2>{ ends[0], ends[1] })) << "edge " << edge;
    ASSERT_EQ(core.edgeLambda[edge], measure(squared)) << "edge " << edge;
    ++edge;
  }
  ASSERT_EQ(core.cells.FaceCount(), brute.faces.size());
  std::size_t face = 0;
  for (const auto & [corners, squared] : brute.faces)
  {
    const auto       polygon = core.cells.FaceVertices(face);
    testing::Indices sorted(polygon.begin(), polygon.end());
    std::sort(sorted.begin(), sorted.end());
    ASSERT_EQ(sorted, corners) << "face " << face;
    ASSERT_EQ(core.faceLambda[face], measure(squared)) << "face " << face;
    ++face;
  }
}

void
ExpectEqualDefinition(std::uint64_t firstSeed, int count, std::int32_t least, std::int32_t greatest)
{
  std::cout << "seeds from " << firstSeed << '\n';
  for (std::uint64_t seed = firstSeed; seed < firstSeed + static_cast<std::uint64_t>(count); ++seed)
  {
    ASSERT_NO_FATAL_FAILURE(ExpectEqualsDefinition(testing::MakeRandomVolume(seed, least, greatest)));
  }
}

TEST(BruteForceCore, EqualsTheDefinitionOnShapesOfUpToThreeVoxelsASide)
{
  ASSERT_NO_FATAL_FAILURE(ExpectEqualDefinition(9000, 180, 1, 3));
}

TEST(BruteForceCore, EqualsTheDefinitionOnShapesOfUpToFourVoxelsASide)
{
  ASSERT_NO_FATAL_FAILURE(ExpectEqualDefinition(9500, 40, 3, 4));
}

TEST(BruteForceCore, EqualsTheDefinitionOnThickBoxes)
{
  testing::RandomVolume volume;
  for (const auto & spacing : testing::TestSpacings())
  {
    volume.spacing = spacing;
    for (const testing::Size3 & size : { testing::Size3{ 3, 3, 3 }, { 4, 4, 2 }, { 2, 3, 5 }, { 4, 4, 4 } })
    {
      volume.shape = testing::Box(size);
      ASSERT_NO_FATAL_FAILURE(ExpectEqualsDefinition(volume));
    }
  }
}

} // namespace
} // namespace voxelcore
