// The merged cells are unique, so engines that share no code must agree to the last bit.

#include "SameCells.h"

#include <cmath>
#include <iostream>

namespace voxelcore
{
namespace
{

using testing::ExpectAgreement;
using testing::RandomVolume;
using testing::ShapeWhere;

void
ExpectOnRandomVolumes(std::uint64_t firstSeed, std::uint64_t count, std::int32_t least, std::int32_t greatest)
{
  std::cout << "seeds " << firstSeed << " to " << firstSeed + count - 1 << '\n';
  for (std::uint64_t seed = firstSeed; seed < firstSeed + count; ++seed)
  {
    ExpectAgreement(testing::MakeRandomVolume(seed, least, greatest));
    ASSERT_FALSE(::testing::Test::HasFailure());
  }
}

// 1,900 in all, in parts that can run side by side.
class EngineAgreementPart : public ::testing::TestWithParam<std::uint64_t>
{};

TEST_P(EngineAgreementPart, OnRandomVolumes)
{
  ExpectOnRandomVolumes(20000 + 380 * GetParam(), 380, 1, 10);
}

INSTANTIATE_TEST_SUITE_P(Parts, EngineAgreementPart, ::testing::Range<std::uint64_t>(0, 5));

TEST(EngineAgreement, OnThickVolumesWithAFewHoles)
{
  // Deep insides, where spheres are large and nearly cospherical points many.
  std::cout << "seeds from 21000\n";
  for (std::uint64_t seed = 21000; seed < 21020; ++seed)
  {
    RandomVolume    volume = testing::MakeRandomVolume(seed, 12, 26);
    testing::Random random(seed);
    const double    holes = random.Chance(0.5) ? 0.002 : 0.02;
    volume.shape =
      ShapeWhere(volume.shape.Box().size, [&](int, int, int) { return !random.Chance(holes); }, { 1000, 70, 3 });
    ExpectAgreement(volume);
    ASSERT_FALSE(HasFailure());
  }
}

TEST(EngineAgreement, OnSmoothSolidsAtEverySpacing)
{
  for (const auto & spacing : testing::TestSpacings())
  {
    RandomVolume volume;
    volume.spacing = spacing;
    volume.shape = testing::Box({ 20, 17, 23 });
    ExpectAgreement(volume);
    ASSERT_FALSE(HasFailure());
    volume.shape = testing::Ellipsoid(40);
    ExpectAgreement(volume);
    ASSERT_FALSE(HasFailure());
    volume.shape = ShapeWhere({ 30, 30, 30 }, [](int x, int y, int z) {
      const auto wave = [](int at) { return 2 * 3.141592653589793 * at / 15; };
      return std::abs(std::sin(wave(x)) * std::cos(wave(y)) + std::sin(wave(y)) * std::cos(wave(z)) +
                      std::sin(wave(z)) * std::cos(wave(x))) < 0.4;
    });
    ExpectAgreement(volume);
    ASSERT_FALSE(HasFailure());
  }
}

TEST(EngineAgreement, OnLongBoxesWiderThanAnyBrick)
{
  RandomVolume volume;
  for (const testing::Size3 & size : { testing::Size3{ 150, 3, 3 }, { 3, 150, 3 }, { 3, 3, 150 }, { 70, 66, 9 } })
  {
    volume.shape = testing::Box(size, { 63, 31, 17 });
    ExpectAgreement(volume);
    ASSERT_FALSE(HasFailure());
  }
}

TEST(EngineAgreement, OnVolumesWithWorkForEveryThread)
{
  std::cout << "seeds from 23000\n";
  ExpectAgreement(testing::Ellipsoid(100), {});
  for (std::uint64_t seed = 23001; seed <= 23004; ++seed)
  {
    testing::Random random(seed);
    ExpectAgreement(testing::RandomShape(random, { 48, 40, 40 }, 0.2 * static_cast<double>(seed - 23000)), {});
  }
}

TEST(EngineAgreement, OnSolidsWhoseDeepCellsSeveralThreadsFind)
{
  ExpectAgreement(testing::Ellipsoid(150), {});
  ASSERT_FALSE(HasFailure());
  // Its deep cells all meet in the middle, so that hardly any can be found apart from the others.
  ExpectAgreement(ShapeWhere({ 96, 96, 96 },
                             [](int x, int y, int z) {
                               const auto square = [](int at) { return (2 * at - 95) * (2 * at - 95); };
                               return square(x) + square(y) + square(z) < 94 * 94;
                             }),
                  {});
  ASSERT_FALSE(HasFailure());
  // Weights make numbers of 128 bits.
  RandomVolume volume;
  volume.shape = testing::Ellipsoid(110);
  volume.spacing = { 0.48828125, 0.48828125, 2.5 };
  ExpectAgreement(volume);
}

TEST(HeavyEngineAgreement, OnLargerRandomVolumes)
{
  ExpectOnRandomVolumes(22000, 100, 15, 40);
}

TEST(HeavyEngineAgreement, OnALargeEllipsoid)
{
  RandomVolume volume;
  volume.shape = testing::Ellipsoid(256);
  ExpectAgreement(volume);
  volume.shape = testing::Ellipsoid(128);
  volume.spacing = { 0.48828125, 0.48828125, 2.5 };
  ExpectAgreement(volume);
}

} // namespace
} // namespace voxelcore
