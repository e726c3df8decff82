#include "voxelcore/Lattice/Rational.h"

#include "VoxelCoreTesting/ExactNumbers.h"
#include "VoxelCoreTesting/Random.h"

#include <gtest/gtest.h>

namespace voxelcore
{
namespace
{

using testing::BigInteger;
using testing::BigRational;
using testing::IsNearestDouble;
using testing::Random;
using testing::ToBigInteger;

// Up to `bits` bits, all lengths alike.
UInt128
RandomNumber(Random & random, int bits)
{
  const auto length = static_cast<int>(random.Between(1, bits));
  UInt128    value = (UInt128{ random.Next() } << 64) | random.Next();
  value >>= 128 - length;
  return value;
}

BigRational
Quotient(UInt128 numerator, UInt128 denominator)
{
  return BigRational(ToBigInteger(static_cast<Int128>(numerator)), ToBigInteger(static_cast<Int128>(denominator)));
}

TEST(Rational, SmallFractionsAreWhatTheMachineDivides)
{
  EXPECT_EQ(RatioToDouble(0, 7), 0.0);
  EXPECT_EQ(RatioToDouble(1, 3), 1.0 / 3.0);
  EXPECT_EQ(RatioToDouble(9, 4), 2.25);
  EXPECT_EQ(SignedRatioToDouble(-9, 4), -2.25);
  EXPECT_EQ(SignedRatioToDouble(2, 3), 2.0 / 3.0);
  EXPECT_EQ(SignedRatioToDouble(0, 5), 0.0);
}

TEST(Rational, TiesGoToTheEvenDouble)
{
  const UInt128 one = UInt128{ 1 } << 60; // 2^60 units of 2^-60; a double near 1 has steps of 2^8 of them
  EXPECT_EQ(RatioToDouble(one + (1U << 7), one), 1.0);
  EXPECT_EQ(RatioToDouble(one + (1U << 7) + 1, one), 1.0 + 0x1p-52);
  EXPECT_EQ(RatioToDouble(one + (3U << 7), one), 1.0 + 0x1p-51);
  EXPECT_EQ(RatioToDouble(one + (3U << 7) - 1, one), 1.0 + 0x1p-52);
  // The same with a denominator that leaves a remainder: 2^60 + 2^7 times 3 over 2^60 times 3, and just beside it.
  EXPECT_EQ(RatioToDouble(3 * (one + (1U << 7)), 3 * one), 1.0);
  EXPECT_EQ(RatioToDouble(3 * (one + (1U << 7)) + 1, 3 * one), 1.0 + 0x1p-52);
  EXPECT_EQ(RatioToDouble(3 * (one + (1U << 7)) - 1, 3 * one), 1.0);
}

TEST(Rational, RoundingUpCanReachTheNextPowerOfTwo)
{
  const UInt128 big = UInt128{ 1 } << 100;
  EXPECT_EQ(RatioToDouble(big - 1, big), 1.0);
  EXPECT_EQ(RatioToDouble(big - 1, 1), 0x1p100);
  EXPECT_EQ(RatioToDouble(1, big - 1), 0x1p-100);
  EXPECT_EQ(RatioToDouble((UInt128{ 1 } << 54) - 1, 1), 0x1p54);
}

TEST(Rational, QuotientsAreTheNearestDoubles)
{
  Random random(71);
  for (int round = 0; round < 20000; ++round)
  {
    const UInt128 numerator = RandomNumber(random, 126);
    const UInt128 denominator = RandomNumber(random, 126) | 1U;
    const double  value = RatioToDouble(numerator, denominator);
    ASSERT_TRUE(IsNearestDouble(value, Quotient(numerator, denominator)) || numerator == 0) << "round " << round;
    ASSERT_EQ(SignedRatioToDouble(-static_cast<Int128>(numerator), denominator), -value);
  }
}

TEST(Rational, ConstructedTiesAndTheirNeighboursAreTheNearestDoubles)
{
  Random random(72);
  for (int round = 0; round < 5000; ++round)
  {
    // A 54-bit odd number lies half way between two doubles.
    const UInt128 half = ((random.Next() >> 10) | 1U) | (UInt128{ 1 } << 53);
    const UInt128 factor = RandomNumber(random, 70) | 1U;
    for (int off = -1; off <= 1; ++off)
    {
      const UInt128 numerator = half * factor + static_cast<UInt128>(static_cast<Int128>(off));
      ASSERT_TRUE(IsNearestDouble(RatioToDouble(numerator, factor), Quotient(numerator, factor)))
        << "round " << round << ", off by " << off;
    }
  }
}

TEST(Rational, TheExtremesOfTheRangeAreTheNearestDoubles)
{
  const UInt128 most = (UInt128{ 1 } << 126) - 1;
  for (const UInt128 numerator : { UInt128{ 1 }, most / 3, most - 1, most })
  {
    for (const UInt128 denominator : { UInt128{ 1 }, UInt128{ 3 }, most / 3, most - 1, most })
    {
      EXPECT_TRUE(IsNearestDouble(RatioToDouble(numerator, denominator), Quotient(numerator, denominator)));
    }
  }
}

TEST(Rational, ComparisonIsExact)
{
  Random    random(73);
  const int lengths[] = { 4, 20, 64, 127 };
  int       ties = 0;
  for (int round = 0; round < 40000; ++round)
  {
    const int    bits = lengths[round % 4];
    const auto   sign = [&] { return random.Chance(0.5) ? Int128{ 1 } : Int128{ -1 }; };
    const Int128 p1 = static_cast<Int128>(RandomNumber(random, bits)) * sign();
    const auto   q1 = static_cast<Int128>(RandomNumber(random, bits) | 1U);
    Int128       p2 = static_cast<Int128>(RandomNumber(random, bits)) * sign();
    auto         q2 = static_cast<Int128>(RandomNumber(random, bits) | 1U);
    if (round % 8 == 3 && bits == 127) // nearly equal, differing deep in the continued fraction
    {
      p2 = p1 - sign();
      q2 = q1;
    }
    const BigInteger difference = ToBigInteger(p1) * ToBigInteger(q2) - ToBigInteger(p2) * ToBigInteger(q1);
    ASSERT_EQ(CompareRatios(p1, q1, p2, q2), difference.sign()) << "round " << round;
    ties += difference == 0;
  }
  EXPECT_GT(ties, 100); // the four-bit ones must have met equality
}

TEST(Rational, EqualRatiosInDifferentTermsAreEqual)
{
  const Int128 most = (Int128{ 1 } << 126) - 1 + (Int128{ 1 } << 126); // 2^127 - 1
  EXPECT_EQ(CompareRatios(1, 3, 2, 6), 0);
  EXPECT_EQ(CompareRatios(-1, 3, -2, 6), 0);
  EXPECT_EQ(CompareRatios(0, 3, 0, 7), 0);
  EXPECT_EQ(CompareRatios(most, most, 1, 1), 0);
  EXPECT_EQ(CompareRatios(-most, most, -1, 1), 0);
  EXPECT_EQ(CompareRatios(most, most - 1, 1, 1), 1);
  EXPECT_EQ(CompareRatios(most - 1, most, most - 2, most - 1), 1);
  EXPECT_EQ(CompareRatios(-most + 1, most, -most + 2, most - 1), -1);
  EXPECT_EQ(CompareRatios(-1, most, 1, most), -1);
}

TEST(Rational, ConsecutiveFibonacciRatiosAlternateAroundTheGoldenOne)
{
  // The deepest continued fractions there are.
  Int128 a = 1;
  Int128 b = 1;
  for (int step = 0; step < 180; ++step)
  {
    const Int128 c = a + b;
    ASSERT_EQ(CompareRatios(b, a, c, b), step % 2 == 0 ? -1 : 1) << step;
    a = b;
    b = c;
  }
}

TEST(Rational, BitLengthCountsUpToTheHighestOne)
{
  EXPECT_EQ(BitLength(0), 0);
  for (int bit = 0; bit < 128; ++bit)
  {
    EXPECT_EQ(BitLength(UInt128{ 1 } << bit), bit + 1);
    EXPECT_EQ(BitLength((UInt128{ 1 } << bit) - 1), bit);
  }
}

} // namespace
} // namespace voxelcore
