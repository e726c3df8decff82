#include "voxelcore/Lattice/SpacingWeights.h"

#include "VoxelCoreTesting/Random.h"

#include "voxelcore/Base/Error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace voxelcore
{
namespace
{

using Weights = std::array<std::int64_t, 3>;

long double
DeviationOf(const Weights & weight, const std::array<double, 3> & spacing)
{
  long double worst = 0;
  for (std::size_t a = 0; a < 3; ++a)
  {
    for (std::size_t b = 0; b < 3; ++b)
    {
      const long double have = static_cast<long double>(weight[a]) / static_cast<long double>(weight[b]);
      const long double want = static_cast<long double>(spacing[a]) / static_cast<long double>(spacing[b]);
      worst = std::max(worst, have / want - 1);
    }
  }
  return worst;
}

// All weights whose greatest is `greatest` and that could be best: each of the others rounded down or up.
template <typename TVisit>
void
VisitCandidates(const std::array<double, 3> & spacing, std::int64_t greatest, TVisit visit)
{
  const double longest = std::max({ spacing[0], spacing[1], spacing[2] });
  for (unsigned choice = 0; choice < 8; ++choice)
  {
    Weights weight{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double share = spacing[axis] / longest * static_cast<double>(greatest);
      weight[axis] = static_cast<std::int64_t>(std::floor(share)) + ((choice >> axis) & 1U);
    }
    if (std::min({ weight[0], weight[1], weight[2] }) >= 1 && std::max({ weight[0], weight[1], weight[2] }) == greatest)
    {
      visit(weight);
    }
  }
}

TEST(SpacingWeights, ThinSlicesOfHalfAMillimetreAreOneToFour)
{
  const SpacingWeights weights = ComputeSpacingWeights({ 0.5, 0.5, 2.0 });
  EXPECT_EQ(weights.weight, (Weights{ 1, 1, 4 }));
  EXPECT_EQ(weights.unit, 0.5);
  EXPECT_EQ(weights.deviation, 0.0);
}

TEST(SpacingWeights, AreInLowestTerms)
{
  EXPECT_EQ(ComputeSpacingWeights({ 3, 3, 7 }).weight, (Weights{ 3, 3, 7 }));
  EXPECT_EQ(ComputeSpacingWeights({ 6, 6, 14 }).weight, (Weights{ 3, 3, 7 }));
  EXPECT_EQ(ComputeSpacingWeights({ 0.48828125, 0.48828125, 2.5 }).weight, (Weights{ 25, 25, 128 }));
  EXPECT_EQ(ComputeSpacingWeights({ 2, 1, 3 }).weight, (Weights{ 2, 1, 3 }));
  EXPECT_EQ(ComputeSpacingWeights({ 0.9, 0.6, 0.3 }).weight, (Weights{ 3, 2, 1 }));
}

TEST(SpacingWeights, CubesKeepTheirSideAsTheUnitToTheLastBit)
{
  for (const double side : { 1.0, 0.1, 0.7, 1.0 / 3.0, 0.9765625, 123.456 })
  {
    const SpacingWeights weights = ComputeSpacingWeights({ side, side, side });
    EXPECT_EQ(weights.weight, (Weights{ 1, 1, 1 }));
    EXPECT_EQ(weights.unit, side);
    EXPECT_EQ(weights.deviation, 0.0);
  }
}

TEST(SpacingWeights, AbsoluteSizeDoesNotMatter)
{
  for (const double scale : { 1e-9, 0.00065, 0.001, 1.0, 1e6 })
  {
    const SpacingWeights weights = ComputeSpacingWeights({ 2 * scale, 2 * scale, 5 * scale });
    EXPECT_EQ(weights.weight, (Weights{ 2, 2, 5 })) << scale;
    EXPECT_NEAR(weights.unit / scale, 1.0, 1e-14);
    EXPECT_LE(weights.deviation, 1e-14);
  }
}

TEST(SpacingWeights, SinglePrecisionNoiseOfAFileHeaderIsNoRatio)
{
  const SpacingWeights weights = ComputeSpacingWeights({ 0.4f, 0.4f, 1.2f });
  EXPECT_EQ(weights.weight, (Weights{ 1, 1, 3 }));
  EXPECT_LE(weights.deviation, 1e-6);
  EXPECT_GT(weights.deviation, 0.0);
}

TEST(SpacingWeights, AreTheSmallestWithinTheTolerance)
{
  // 1000001 : 1000000 is just within 1e-6 of 1 : 1; a little more is not.
  EXPECT_EQ(ComputeSpacingWeights({ 1.0, 1.0, 1.0 + 0.9e-6 }).weight, (Weights{ 1, 1, 1 }));
  EXPECT_NE(ComputeSpacingWeights({ 1.0, 1.0, 1.0 + 400e-6 }).weight, (Weights{ 1, 1, 1 }));
  testing::Random random(20181);
  for (int round = 0; round < 200; ++round)
  {
    std::array<double, 3> spacing{};
    for (double & s : spacing)
    {
      s = static_cast<double>(random.Between(1, 400)) * 0.0125;
    }
    const SpacingWeights weights = ComputeSpacingWeights(spacing);
    const auto           greatest = std::max({ weights.weight[0], weights.weight[1], weights.weight[2] });
    ASSERT_LE(weights.deviation, 1e-6) << round;
    for (std::int64_t smaller = 1; smaller < greatest; ++smaller)
    {
      VisitCandidates(spacing, smaller, [&](const Weights & weight) {
        ASSERT_GT(DeviationOf(weight, spacing), 1e-6L) << "round " << round << ", greatest weight " << smaller;
      });
    }
  }
}

TEST(SpacingWeights, RatiosWithoutSmallIntegersGetTheBestUpTo4096AndSayHowFarOff)
{
  const std::array<double, 3> irrational{ 1.0, std::sqrt(2.0), std::acos(-1.0) };
  testing::Random             random(20182);
  for (int round = 0; round < 300; ++round)
  {
    std::array<double, 3> spacing = irrational;
    if (round > 0)
    {
      for (double & s : spacing)
      {
        s = 0.1 + random.Unit() * (round % 2 == 0 ? 2.0 : 0.1);
      }
    }
    SCOPED_TRACE(round);
    const SpacingWeights weights = ComputeSpacingWeights(spacing);
    const long double    own = DeviationOf(weights.weight, spacing);
    EXPECT_NEAR(weights.deviation, static_cast<double>(own), 1e-12);
    ASSERT_LE(std::max({ weights.weight[0], weights.weight[1], weights.weight[2] }), 4096);
    if (weights.deviation <= 1e-6)
    {
      continue;
    }
    long double best = std::numeric_limits<long double>::infinity();
    for (std::int64_t greatest = 1; greatest <= 4096; ++greatest)
    {
      VisitCandidates(spacing, greatest, [&](const Weights & weight) {
        best = std::min(best, DeviationOf(weight, spacing));
      });
    }
    EXPECT_LE(own, best + 1e-15L);
  }
}

TEST(SpacingWeights, RatiosThatNoWeightsMatchAreRefused)
{
  for (const std::array<double, 3> & spacing :
       std::initializer_list<std::array<double, 3>>{ { 0.0001, 1, 1 },
                                                     { 0.001, 1, 100 },
                                                     { 1, 1, 4096 * 1.0011 },
                                                     { 1, std::sqrt(2.0), 1000 },
                                                     { 1, 1, 4294967297.0 },
                                                     { 1, 1e26, 2 },
                                                     { 1, 1.08420217e-19, 2 } })
  {
    try
    {
      ComputeSpacingWeights(spacing);
      FAIL() << ::testing::PrintToString(spacing);
    }
    catch (const InputError & error)
    {
      const std::string text = error.what();
      EXPECT_NE(text.find("give the right spacing"), std::string::npos) << text;
      EXPECT_EQ(text.find("--"), std::string::npos) << "libraries have no options: " << text;
    }
  }
}

TEST(SpacingWeights, DeviationsUpToAThousandthAreAccepted)
{
  // One to the largest weight is the best there is for these, and what is missing is the deviation.
  for (const double deviation : { 0.5e-6, 2e-6, 1e-4, 0.999e-3 })
  {
    const SpacingWeights weights = ComputeSpacingWeights({ 1, 1, 4096 * (1 + deviation) });
    EXPECT_EQ(weights.weight, (Weights{ 1, 1, 4096 }));
    EXPECT_NEAR(weights.deviation, deviation, 1e-12);
  }
  EXPECT_THROW(ComputeSpacingWeights({ 1, 1, 4096 * (1 + 1.001e-3) }), InputError);
  try
  {
    ComputeSpacingWeights({ 1, 1, 9999 });
    ADD_FAILURE() << "its ratio is above 4096";
  }
  catch (const InputError & error)
  {
    EXPECT_NE(std::string(error.what()).find("is off by 144 %"), std::string::npos) << error.what();
  }
  // Ratios that no whole numbers have at all.
  for (const std::array<double, 3> & spacing :
       std::initializer_list<std::array<double, 3>>{ { 1, std::sqrt(2.0), std::acos(-1.0) },
                                                     { std::exp(1.0), std::sqrt(3.0), 0.1 },
                                                     { 1, std::sqrt(2.0), 100 } })
  {
    EXPECT_LE(ComputeSpacingWeights(spacing).deviation, kLargestDeviation);
  }
}

TEST(SpacingWeights, SpacingsThatNothingHasAreRefused)
{
  for (const double bad : { 4.6e-41, 5e-324, 1e-13, 1e13, 1e300 })
  {
    EXPECT_THROW(ComputeSpacingWeights({ bad, bad, bad }), InputError) << bad;
  }
  for (const double good : { 1e-12, 1e-6, 1e6, 1e12 })
  {
    EXPECT_EQ(ComputeSpacingWeights({ good, good, good }).unit, good);
  }
}

TEST(SpacingWeights, OfAnImageNeedPlacesThatDoublesTellApart)
{
  ImageGeometry geometry;
  geometry.size = { 100, 100, 100 };
  EXPECT_EQ(ComputeLatticeWeights(geometry).weight, (Weights{ 1, 1, 1 }));
  for (const double far : { 1.8446744e19, -1e15, 1e11, std::nan(""), std::numeric_limits<double>::infinity() })
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      ImageGeometry off = geometry;
      off.origin[axis] = far;
      EXPECT_THROW(ComputeLatticeWeights(off), InputError) << far;
    }
  }
  geometry.direction[4] = std::nan("");
  EXPECT_THROW(ComputeLatticeWeights(geometry), InputError);
}

TEST(SpacingWeights, AMicrometreAKilometreAwayIsAPlace)
{
  ImageGeometry geometry;
  geometry.size = { 4096, 4096, 4096 };
  geometry.spacing = { 0.001, 0.001, 0.001 };
  geometry.origin = { 1e6, -1e6, 1e6 };
  EXPECT_EQ(ComputeLatticeWeights(geometry).unit, 0.001);
  const Vector3 there{ 4000.25, 17.5, 0.125 };
  const Vector3 back = PhysicalToLattice(geometry, LatticeToPhysical(geometry, there));
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    EXPECT_NEAR(back[axis], there[axis], 1e-6);
  }
}

TEST(SpacingWeights, TheUnitIsTheGeometricMeanOfSpacingOverWeight)
{
  const std::array<double, 3> spacing{ 1.0, std::sqrt(2.0), std::acos(-1.0) };
  const SpacingWeights        weights = ComputeSpacingWeights(spacing);
  long double                 product = 1;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    product *= static_cast<long double>(spacing[axis]) / static_cast<long double>(weights.weight[axis]);
  }
  EXPECT_NEAR(weights.unit, static_cast<double>(std::cbrt(product)), 1e-15);
}

TEST(SpacingWeights, WithoutSenseAreRefused)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  for (const double bad : { 0.0, -0.0, -1.0, nan, infinite, -infinite })
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      std::array<double, 3> spacing{ 1, 1, 1 };
      spacing[axis] = bad;
      EXPECT_THROW(ComputeSpacingWeights(spacing), InputError) << bad << " on axis " << axis;
    }
  }
}

} // namespace
} // namespace voxelcore
