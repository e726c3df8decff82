// The merged cells are unique, so engines that share no code must agree to the last bit.

#include "VoxelCoreTesting/Shapes.h"

#include "voxelcore/BoundaryVertices.h"
#include "voxelcore/DelaunayCells.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <iostream>

namespace voxelcore
{
namespace
{

using testing::RandomVolume;
using testing::ShapeWhere;

// Compared as wholes: millions of numbers in a failure help nobody.
void
ExpectSameCells(const DelaunayCells & a, const DelaunayCells & b)
{
  ASSERT_EQ(a.CellCount(), b.CellCount());
  ASSERT_EQ(a.FacetCount(), b.FacetCount());
  ASSERT_TRUE(a.centres == b.centres);
  ASSERT_TRUE(a.facetCells == b.facetCells);
  ASSERT_TRUE(a.facetOffsets == b.facetOffsets);
  ASSERT_TRUE(a.facetPoints == b.facetPoints);
}

void
ExpectAgreement(const RandomVolume & volume)
{
  SCOPED_TRACE(volume.Describe());
  const auto           points = BoundaryVertices(volume.shape);
  const SpacingWeights weights = ComputeSpacingWeights(volume.spacing);
  const DelaunayCells  a = ComputeDelaunayCells(volume.shape, points, weights, Engine::TetGen);
  const DelaunayCells  b = ComputeDelaunayCells(volume.shape, points, weights, Engine::Lattice);
  ASSERT_NO_FATAL_FAILURE(ExpectSameCells(a, b));
}

class EngineAgreement : public ::testing::Test
{
protected:
  void
  SetUp() override
  {
    if (!HasEngine(Engine::TetGen))
    {
      GTEST_SKIP() << "this build has one engine only";
    }
  }

  static void
  ExpectOnRandomVolumes(std::uint64_t firstSeed, std::uint64_t count, std::int32_t least, std::int32_t greatest)
  {
    std::cout << "seeds " << firstSeed << " to " << firstSeed + count - 1 << '\n';
    for (std::uint64_t seed = firstSeed; seed < firstSeed + count; ++seed)
    {
      ASSERT_NO_FATAL_FAILURE(ExpectAgreement(testing::MakeRandomVolume(seed, least, greatest)));
    }
  }
};

class HeavyEngineAgreement : public EngineAgreement
{};

TEST_F(EngineAgreement, OnRandomVolumes)
{
  ExpectOnRandomVolumes(20000, 300, 1, 14);
}

TEST_F(EngineAgreement, OnThickVolumesWithAFewHoles)
{
  // Deep insides, where spheres are large and nearly cospherical points many.
  std::cout << "seeds from 21000\n";
  for (std::uint64_t seed = 21000; seed < 21030; ++seed)
  {
    RandomVolume    volume = testing::MakeRandomVolume(seed, 12, 26);
    testing::Random random(seed);
    const double    holes = random.Chance(0.5) ? 0.002 : 0.02;
    volume.shape =
      ShapeWhere(volume.shape.Box().size, [&](int, int, int) { return !random.Chance(holes); }, { 1000, 70, 3 });
    ASSERT_NO_FATAL_FAILURE(ExpectAgreement(volume));
  }
}

TEST_F(EngineAgreement, OnSmoothSolidsAtEverySpacing)
{
  for (const auto & spacing : testing::TestSpacings())
  {
    RandomVolume volume;
    volume.spacing = spacing;
    volume.shape = testing::Box({ 20, 17, 23 });
    ASSERT_NO_FATAL_FAILURE(ExpectAgreement(volume));
    volume.shape = testing::Ellipsoid(40);
    ASSERT_NO_FATAL_FAILURE(ExpectAgreement(volume));
    volume.shape = ShapeWhere({ 30, 30, 30 }, [](int x, int y, int z) {
      const auto wave = [](int at) { return 2 * 3.141592653589793 * at / 15; };
      return std::abs(std::sin(wave(x)) * std::cos(wave(y)) + std::sin(wave(y)) * std::cos(wave(z)) +
                      std::sin(wave(z)) * std::cos(wave(x))) < 0.4;
    });
    ASSERT_NO_FATAL_FAILURE(ExpectAgreement(volume));
  }
}

TEST_F(EngineAgreement, OnLongBoxesWiderThanAnyBrick)
{
  RandomVolume volume;
  for (const testing::Size3 & size : { testing::Size3{ 150, 3, 3 }, { 3, 150, 3 }, { 3, 3, 150 }, { 70, 66, 9 } })
  {
    volume.shape = testing::Box(size, { 63, 31, 17 });
    ASSERT_NO_FATAL_FAILURE(ExpectAgreement(volume));
  }
}

TEST(Threads, DoNotChangeTheCells)
{
  struct RestoreThreads
  {
    int before = omp_get_max_threads();
    ~RestoreThreads()
    {
      omp_set_num_threads(before);
    }
  } restore;
  std::cout << "seeds from 23000\n";
  for (std::uint64_t seed = 23000; seed < 23040; ++seed)
  {
    RandomVolume volume = testing::MakeRandomVolume(seed, 3, 24);
    // Enough boundary vertices for every loop to run in parallel, on smooth and on ragged shapes.
    if (seed == 23000)
    {
      volume.shape = testing::Ellipsoid(170);
    }
    else if (seed <= 23004)
    {
      testing::Random random(seed);
      volume.shape = testing::RandomShape(random, { 48, 40, 40 }, 0.2 * static_cast<double>(seed - 23000));
    }
    SCOPED_TRACE(volume.Describe());
    const auto           points = BoundaryVertices(volume.shape);
    const SpacingWeights weights = ComputeSpacingWeights(volume.spacing);
    omp_set_num_threads(1);
    const DelaunayCells alone = ComputeDelaunayCells(volume.shape, points, weights, Engine::Lattice);
    for (const int threads : { 2, 3, 7 })
    {
      omp_set_num_threads(threads);
      ASSERT_NO_FATAL_FAILURE(
        ExpectSameCells(ComputeDelaunayCells(volume.shape, points, weights, Engine::Lattice), alone));
    }
  }
}

TEST_F(HeavyEngineAgreement, OnLargerRandomVolumes)
{
  ExpectOnRandomVolumes(22000, 100, 15, 40);
}

TEST_F(HeavyEngineAgreement, OnALargeEllipsoid)
{
  RandomVolume volume;
  volume.shape = testing::Ellipsoid(256);
  ASSERT_NO_FATAL_FAILURE(ExpectAgreement(volume));
  volume.shape = testing::Ellipsoid(128);
  volume.spacing = { 0.48828125, 0.48828125, 2.5 };
  ASSERT_NO_FATAL_FAILURE(ExpectAgreement(volume));
}

} // namespace
} // namespace voxelcore
