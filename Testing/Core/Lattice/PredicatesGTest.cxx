#include "voxelcore/Lattice/Predicates.h"

#include "VoxelCoreTesting/ExactNumbers.h"
#include "VoxelCoreTesting/Random.h"

#include <gtest/gtest.h>

#include <vector>

namespace voxelcore
{
namespace
{

using testing::BigInteger;
using testing::BigRational;
using testing::BigVector;
using testing::ExactCircumcentre;
using testing::ExactDeterminant;
using testing::ExactSquaredDistance;
using testing::IsNearestDouble;
using testing::Random;
using testing::ToBigInteger;
using testing::ToBigVector;
using testing::operator-;

SpacingWeights
MakeWeights(std::int64_t x, std::int64_t y, std::int64_t z)
{
  SpacingWeights weights;
  weights.weight = { x, y, z };
  return weights;
}

// One random situation: five points within `extent`, small extents so that ties and flat sets occur.
struct Situation
{
  SpacingWeights            weights;
  std::vector<LatticePoint> p;
};

Situation
MakeSituation(std::uint64_t round)
{
  static const SpacingWeights all[] = { MakeWeights(1, 1, 1),       MakeWeights(1, 1, 2),
                                        MakeWeights(3, 3, 7),       MakeWeights(25, 25, 128),
                                        MakeWeights(4096, 1, 1),    MakeWeights(1, 4096, 4095),
                                        MakeWeights(4096, 4096, 1), MakeWeights(4095, 4096, 4093) };
  static const std::int64_t   extents[] = { 1, 2, 3, 10, 500, 3000, 60000, 1 << 19 };
  Random                      random(round);
  Situation                   situation;
  situation.weights = all[random.Between(0, 7)];
  const std::int64_t extent = extents[random.Between(0, 7)];
  const std::int64_t offset = random.Between(0, (1 << 20) - extent);
  for (int i = 0; i < 6; ++i)
  {
    // Corners of the box often: there the intermediate values are largest.
    const auto coordinate = [&] {
      return static_cast<std::int32_t>(
        offset + (random.Chance(0.3) ? extent * random.Between(0, 1) : random.Between(0, extent)));
    };
    situation.p.push_back({ coordinate(), coordinate(), coordinate() });
  }
  return situation;
}

constexpr std::uint64_t rounds = 6000;

BigRational
Big(Int128 value)
{
  return BigRational(ToBigInteger(value));
}

int
SignOf(const BigRational & value)
{
  return value.sign();
}

TEST(Predicates, OrientationIsTheDeterminant)
{
  EXPECT_EQ(Orientation({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }), 1);
  EXPECT_EQ(Orientation({ 0, 0, 0 }, { 0, 1, 0 }, { 1, 0, 0 }, { 0, 0, 1 }), -1);
  EXPECT_EQ(Orientation({ 5, 5, 5 }, { 6, 5, 5 }, { 5, 6, 5 }, { 9, 9, 5 }), 0);
  for (std::uint64_t round = 0; round < rounds; ++round)
  {
    const auto [weights, p] = MakeSituation(round);
    const BigRational exact = ExactDeterminant(ToBigVector(p[1]) - ToBigVector(p[0]),
                                               ToBigVector(p[2]) - ToBigVector(p[0]),
                                               ToBigVector(p[3]) - ToBigVector(p[0]));
    ASSERT_EQ(Big(Orientation(p[0], p[1], p[2], p[3])), exact) << "round " << round;
  }
}

TEST(Predicates, SquaredDistancesAreExact)
{
  EXPECT_EQ(SquaredDistance({ 0, 0, 0 }, { 1, 1, 1 }, MakeWeights(3, 3, 7)), 9 + 9 + 49);
  for (std::uint64_t round = 0; round < rounds; ++round)
  {
    const auto [weights, p] = MakeSituation(round);
    ASSERT_EQ(Big(SquaredDistance(p[0], p[1], weights)),
              ExactSquaredDistance(ToBigVector(p[0]), ToBigVector(p[1]), weights))
      << "round " << round;
  }
}

TEST(Predicates, TheSphereOfAVoxelsCornersSitsAtItsCentre)
{
  const SpacingWeights weights = MakeWeights(1, 1, 4);
  const CircumSphere   sphere = MakeCircumSphere({ 2, 3, 4 }, { 3, 3, 4 }, { 2, 4, 4 }, { 2, 3, 5 }, weights);
  EXPECT_EQ(CentreCoordinate(sphere, 0, weights), 2.5);
  EXPECT_EQ(CentreCoordinate(sphere, 1, weights), 3.5);
  EXPECT_EQ(CentreCoordinate(sphere, 2, weights), 4.5);
  EXPECT_EQ(SquaredRadius(sphere, weights), 18.0 / 4.0);
  EXPECT_EQ(Power(sphere, { 3, 4, 5 }, weights), 0);
  EXPECT_LT(Power(sphere, { 3, 4, 4 }, MakeWeights(1, 1, 5)), 1);
  EXPECT_GT(Power(sphere, { 4, 4, 5 }, weights), 0);
}

TEST(Predicates, FlatSetsHaveNoSphere)
{
  for (std::uint64_t round = 0; round < rounds; ++round)
  {
    auto [weights, p] = MakeSituation(round);
    switch (round % 3)
    {
      case 0:
        p[3] = p[0];
        break;
      case 1:
        p[3] = { p[0].x, p[3].y, p[3].z };
        p[1].x = p[2].x = p[0].x;
        break;
      default: // the fourth corner of a parallelogram
        p[3] = { p[1].x + p[2].x - p[0].x, p[1].y + p[2].y - p[0].y, p[1].z + p[2].z - p[0].z };
    }
    ASSERT_EQ(MakeCircumSphere(p[0], p[1], p[2], p[3], weights).det, 0) << "round " << round;
    ASSERT_EQ(Orientation(p[0], p[1], p[2], p[3]), 0) << "round " << round;
  }
}

TEST(Predicates, SpheresCentresPowersAndRadiiAreExact)
{
  int spheres = 0;
  int onTheSphere = 0;
  for (std::uint64_t round = 0; round < rounds; ++round)
  {
    SCOPED_TRACE(round);
    const auto [weights, p] = MakeSituation(round);
    const CircumSphere sphere = MakeCircumSphere(p[0], p[1], p[2], p[3], weights);
    const auto         centre = ExactCircumcentre({ p[0], p[1], p[2], p[3] }, weights);
    ASSERT_EQ(sphere.det == 0, !centre);
    if (!centre)
    {
      continue;
    }
    ++spheres;
    ASSERT_GT(sphere.det, 0);
    const BigRational squaredRadius = ExactSquaredDistance(*centre, ToBigVector(p[0]), weights);
    for (std::size_t i = 0; i < 6; ++i)
    {
      const BigRational beyond = ExactSquaredDistance(*centre, ToBigVector(p[i]), weights) - squaredRadius;
      ASSERT_EQ(Big(Power(sphere, p[i], weights)), Big(sphere.det) * beyond) << "point " << i;
      onTheSphere += i > 3 && beyond == 0;
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double coordinate = CentreCoordinate(sphere, axis, weights);
      ASSERT_TRUE((*centre)[axis] == 0 ? coordinate == 0 : IsNearestDouble(coordinate, (*centre)[axis])) << axis;
    }
    ASSERT_TRUE(IsNearestDouble(SquaredRadius(sphere, weights), squaredRadius));
  }
  EXPECT_GT(spheres, 3000);
  EXPECT_GT(onTheSphere, 100); // ties must have occurred
}

TEST(Predicates, CentresAreComparedExactly)
{
  int ties = 0;
  for (std::uint64_t round = 0; round < rounds; ++round)
  {
    SCOPED_TRACE(round);
    const auto [weights, p] = MakeSituation(round);
    const CircumSphere a = MakeCircumSphere(p[0], p[1], p[2], p[3], weights);
    const CircumSphere b = MakeCircumSphere(p[5], p[4], p[2], p[1], weights);
    const auto         centreA = ExactCircumcentre({ p[0], p[1], p[2], p[3] }, weights);
    const auto         centreB = ExactCircumcentre({ p[5], p[4], p[2], p[1] }, weights);
    if (!centreA || !centreB)
    {
      continue;
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const int expected = SignOf((*centreA)[axis] - (*centreB)[axis]);
      ASSERT_EQ(CompareCentreCoordinates(a, b, axis, weights), expected);
      ASSERT_EQ(CompareCentreCoordinates(b, a, axis, weights), -expected);
      ties += expected == 0;
    }
  }
  EXPECT_GT(ties, 100);
}

TEST(Predicates, CirclesOfThreePointsAreExact)
{
  // Half the square's diagonal, and the equilateral triangle of side sqrt(2).
  EXPECT_EQ(SquaredCircumradius({ 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, MakeWeights(1, 1, 1)), 0.5);
  EXPECT_EQ(SquaredCircumradius({ 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, MakeWeights(1, 1, 1)), 2.0 / 3.0);
  for (std::uint64_t round = 0; round < rounds; ++round)
  {
    const auto [weights, p] = MakeSituation(round);
    const auto centre = ExactCircumcentre({ p[0], p[1], p[2] }, weights);
    if (centre)
    {
      ASSERT_TRUE(IsNearestDouble(SquaredCircumradius(p[0], p[1], p[2], weights),
                                  ExactSquaredDistance(*centre, ToBigVector(p[0]), weights)))
        << "round " << round;
    }
  }
}

TEST(Predicates, CentreSideIsTheSideOfTheApex)
{
  // The apex of a flat pyramid sees the centre beyond the base, that of a steep one on its own side.
  EXPECT_EQ(CentreSide({ 2, 0, 0 }, { -2, 0, 0 }, { 0, 2, 0 }, { 0, 0, 1 }, MakeWeights(1, 1, 1)), -1);
  EXPECT_EQ(CentreSide({ 2, 0, 0 }, { -2, 0, 0 }, { 0, 2, 0 }, { 0, 0, 2 }, MakeWeights(1, 1, 1)), 0);
  EXPECT_EQ(CentreSide({ 2, 0, 0 }, { -2, 0, 0 }, { 0, 2, 0 }, { 0, 0, 3 }, MakeWeights(1, 1, 1)), 1);
  int onThePlane = 0;
  for (std::uint64_t round = 0; round < rounds; ++round)
  {
    const auto [weights, p] = MakeSituation(round);
    const auto sphere = ExactCircumcentre({ p[0], p[1], p[2], p[3] }, weights);
    if (!sphere)
    {
      continue;
    }
    const BigVector a = ToBigVector(p[0]);
    const BigVector u = ToBigVector(p[1]) - a;
    const BigVector v = ToBigVector(p[2]) - a;
    const int       centreSide = SignOf(ExactDeterminant(u, v, *sphere - a));
    const int       apexSide = SignOf(ExactDeterminant(u, v, ToBigVector(p[3]) - a));
    ASSERT_EQ(CentreSide(p[0], p[1], p[2], p[3], weights), centreSide * apexSide) << "round " << round;
    onThePlane += centreSide == 0;
  }
  EXPECT_GT(onThePlane, 50);
}

TEST(Predicates, AngleSignTellsAcuteFromObtuse)
{
  EXPECT_EQ(AngleSign({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, MakeWeights(1, 1, 1)), 0);
  EXPECT_EQ(AngleSign({ 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, MakeWeights(1, 1, 1)), 1);
  EXPECT_EQ(AngleSign({ 0, 0, 0 }, { 1, 0, 0 }, { -1, 1, 0 }, MakeWeights(1, 1, 1)), -1);
  // The metric decides: a right angle of cubes is obtuse or acute on other boxes.
  EXPECT_EQ(AngleSign({ 0, 0, 0 }, { 1, 1, 0 }, { 1, -1, 0 }, MakeWeights(2, 1, 1)), 1);
  EXPECT_EQ(AngleSign({ 0, 0, 0 }, { 1, 1, 0 }, { 1, -1, 0 }, MakeWeights(1, 2, 1)), -1);
  for (std::uint64_t round = 0; round < rounds; ++round)
  {
    const auto [weights, p] = MakeSituation(round);
    // u.v = (|u|^2 + |v|^2 - |u - v|^2) / 2
    const BigVector   o = ToBigVector(p[0]);
    const BigVector   a = ToBigVector(p[1]);
    const BigVector   b = ToBigVector(p[2]);
    const BigRational twice =
      ExactSquaredDistance(o, a, weights) + ExactSquaredDistance(o, b, weights) - ExactSquaredDistance(a, b, weights);
    ASSERT_EQ(AngleSign(p[0], p[1], p[2], weights), SignOf(twice)) << "round " << round;
  }
}

TEST(Predicates, TheExactRangeEndsWhereTheInSphereValueWouldOverflow)
{
  const BigInteger limit = BigInteger(1) << 127;
  const auto       exact = [&](std::int64_t extent, std::int64_t w) {
    BigInteger value = 72;
    value *= BigInteger(w) * w;
    for (int i = 0; i < 5; ++i)
    {
      value *= extent;
    }
    return value < limit;
  };
  EXPECT_TRUE(ExactRangeAllows(1 << 19, MakeWeights(4096, 1, 1)));
  EXPECT_TRUE(ExactRangeAllows(0, MakeWeights(1, 1, 1)));
  EXPECT_TRUE(ExactRangeAllows(1, MakeWeights(4096, 4096, 4096)));
  EXPECT_FALSE(ExactRangeAllows(std::int64_t{ 1 } << 30, MakeWeights(1, 1, 1)));
  for (const std::int64_t w : { 1, 2, 7, 128, 1000, 4096 })
  {
    std::int64_t allowed = 1;
    std::int64_t refused = std::int64_t{ 1 } << 31;
    while (refused - allowed > 1)
    {
      const std::int64_t middle = (allowed + refused) / 2;
      (ExactRangeAllows(middle, MakeWeights(1, w, 1)) ? allowed : refused) = middle;
    }
    EXPECT_TRUE(exact(allowed, w)) << w;
    EXPECT_FALSE(exact(refused + refused / 200, w)) << "gives up too early at weight " << w;
  }
}

} // namespace
} // namespace voxelcore
