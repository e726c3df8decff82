#include "voxelcore/Lattice/Vectors.h"

#include "VoxelCoreTesting/Random.h"

#include <gtest/gtest.h>

namespace voxelcore
{
namespace
{

TEST(Vectors, OfWholeNumbersAreExact)
{
  const Vector3 a{ 3, -4, 12 };
  const Vector3 b{ 2, 5, -1 };
  EXPECT_EQ(Minus(a, b), (Vector3{ 1, -9, 13 }));
  EXPECT_EQ(AddScaled(a, 2, b), (Vector3{ 7, 6, 10 }));
  EXPECT_EQ(Times(a, b), (Vector3{ 6, -20, -12 }));
  EXPECT_EQ(Over(Times(a, b), b), a);
  EXPECT_EQ(Dot(a, b), 3 * 2 - 4 * 5 - 12);
  EXPECT_EQ(Length(a), 13);
  EXPECT_EQ(Distance(AddScaled(b, 1, a), b), 13);
}

TEST(Vectors, TheCrossProductIsRightHandedOrthogonalAndTheParallelogramsArea)
{
  EXPECT_EQ(Cross({ 1, 0, 0 }, { 0, 1, 0 }), (Vector3{ 0, 0, 1 }));
  EXPECT_EQ(Cross({ 0, 1, 0 }, { 0, 0, 1 }), (Vector3{ 1, 0, 0 }));
  constexpr std::uint64_t seed = 5;
  testing::Random         random(seed);
  const auto any = [&] { return Vector3{ random.Unit() - 0.5, random.Unit() - 0.5, random.Unit() - 0.5 }; };
  for (int round = 0; round < 100; ++round)
  {
    const Vector3 a = any();
    const Vector3 b = any();
    const Vector3 across = Cross(a, b);
    EXPECT_NEAR(Dot(across, a), 0, 1e-15) << "seed " << seed;
    EXPECT_NEAR(Dot(across, b), 0, 1e-15) << "seed " << seed;
    EXPECT_NEAR(Dot(across, across), Dot(a, a) * Dot(b, b) - Dot(a, b) * Dot(a, b), 1e-15) << "seed " << seed;
  }
}

TEST(Vectors, AnglesAreInDegreesWhateverTheLengths)
{
  EXPECT_NEAR(AngleDegrees({ 2, 0, 0 }, { 0, 0, 5 }), 90, 1e-12);
  EXPECT_NEAR(AngleDegrees({ 1, 1, 0 }, { 3, 0, 0 }), 45, 1e-12);
  EXPECT_NEAR(AngleDegrees({ 0.1, 0.7, 0.3 }, { -0.2, -1.4, -0.6 }), 180, 1e-5);
  EXPECT_TRUE(std::isnan(AngleDegrees({ 0, 0, 0 }, { 1, 0, 0 })));
}

} // namespace
} // namespace voxelcore
