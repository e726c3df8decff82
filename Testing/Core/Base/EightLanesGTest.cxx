#include "VoxelCoreTesting/Random.h"

#include "voxelcore/Base/EightLanes.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <iostream>
#include <limits>
#include <numeric>
#include <vector>

namespace voxelcore::testing
{

// Outside the nameless namespace, as the loader has to find what it chooses from.

/** What the loops that ask for eight lanes are made of: products added to sums, differences, the greater of two. */
VOXELCORE_EIGHT_LANES void
BlurInLanes(const float * in, const float * weight, float * out, std::size_t count)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    out[i] = in[i] * weight[0] + in[i + 1] * weight[1] - in[i + 2] * weight[2];
  }
}

VOXELCORE_EIGHT_LANES void
DistancesInLanes(const std::int32_t * x, const std::int32_t * y, std::int32_t * out, std::size_t count)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::int32_t d = x[i] * x[i] + y[i] * y[i];
    out[i] = d > out[i] ? d : out[i];
  }
}

/** The eight after the next `shift` added to those at `to`, by pointers whose type is deduced. */
VOXELCORE_EIGHT_LANES void
AddEights(const float * from, std::size_t shift, float * to)
{
  const auto at = [](auto * place, std::size_t i) __attribute__((always_inline))
  {
    return EightAt(place + i);
  };
  at(to, 0)->lanes = at(from, shift)->lanes + at(to, 0)->lanes;
}

namespace
{

/** One at a time, each step rounded by itself. */
float
BlurOfOne(const float * in, const float * weight)
{
  const volatile float first = in[0] * weight[0];
  const volatile float second = in[1] * weight[1];
  const volatile float third = in[2] * weight[2];
  const volatile float sum = first + second;
  return sum - third;
}

/** Of any size, and now and then what is at the ends of a float's range. */
float
AnyFloat(Random & random)
{
  using Limits = std::numeric_limits<float>;
  constexpr std::array<float, 8> extremes{ 0,
                                           -0.0F,
                                           Limits::max(),
                                           Limits::lowest(),
                                           Limits::min(),
                                           Limits::denorm_min(),
                                           Limits::infinity(),
                                           1 + Limits::epsilon() };
  if (random.Chance(0.1))
  {
    return extremes[static_cast<std::size_t>(random.Between(0, 7))];
  }
  return static_cast<float>(random.Unit() - 0.5) *
         std::bit_cast<float>(static_cast<std::uint32_t>(random.Between(64, 190)) << 23U);
}

TEST(EightLanes, RealNumbersHaveTheBitsOfOneAtATime)
{
  constexpr std::uint64_t seed = 20261122;
  std::cout << "seed " << seed << '\n';
  Random random(seed);
  for (int round = 0; round < 2000; ++round)
  {
    const auto         count = static_cast<std::size_t>(random.Between(0, 40)); // also beside whole eights
    std::vector<float> in(count + 2);
    for (float & value : in)
    {
      value = AnyFloat(random);
    }
    const std::array<float, 3> weight{ AnyFloat(random), AnyFloat(random), AnyFloat(random) };
    std::vector<float>         out(count + 1, 42.0F);
    BlurInLanes(in.data(), weight.data(), out.data(), count);
    for (std::size_t i = 0; i < count; ++i)
    {
      const float expected = BlurOfOne(in.data() + i, weight.data());
      if (expected != expected)
      {
        EXPECT_NE(out[i], out[i]) << "round " << round << ", lane " << i;
        continue;
      }
      ASSERT_EQ(std::bit_cast<std::uint32_t>(out[i]), std::bit_cast<std::uint32_t>(expected))
        << "round " << round << ", lane " << i << ": " << out[i] << " for " << expected;
    }
    ASSERT_EQ(out[count], 42.0F) << "nothing is written behind the last";
  }
}

TEST(EightLanes, AProductIsRoundedBeforeItIsAdded)
{
  // (1 + e)^2 - (1 + 2e) is e^2 where the product is not rounded, as fused instructions do it, and else nothing.
  constexpr float            e = std::numeric_limits<float>::epsilon();
  std::vector<float>         in(66, 1 + e);
  const std::array<float, 3> weight{ 1 + e, 0, (1 + 2 * e) / (1 + e) };
  std::vector<float>         out(64);
  const std::array<float, 3> third{ in[0], in[1], in[2] };
  const float                expected = BlurOfOne(third.data(), weight.data());
  BlurInLanes(in.data(), weight.data(), out.data(), out.size());
  for (const float value : out)
  {
    EXPECT_EQ(std::bit_cast<std::uint32_t>(value), std::bit_cast<std::uint32_t>(expected));
  }
}

TEST(EightLanes, EightFloatsAreReadAndWrittenWhereverAFloatMayLie)
{
  alignas(64) std::array<float, 40> from{};
  std::iota(from.begin(), from.end(), 1.0F);
  for (std::size_t shift = 0; shift < 17; ++shift)
  {
    for (std::size_t begin = 0; begin < 17; ++begin)
    {
      alignas(64) std::array<float, 40> to{};
      to.fill(-2);
      AddEights(from.data(), shift, to.data() + begin);
      for (std::size_t i = 0; i < to.size(); ++i)
      {
        const bool added = i >= begin && i < begin + 8;
        ASSERT_EQ(to[i], added ? from[i - begin + shift] - 2 : -2) << shift << ' ' << begin << ' ' << i;
      }
    }
  }
}

TEST(EightLanes, WholeNumbersAreThoseOfOneAtATime)
{
  constexpr std::uint64_t seed = 1122;
  std::cout << "seed " << seed << '\n';
  Random random(seed);
  for (int round = 0; round < 500; ++round)
  {
    const auto                count = static_cast<std::size_t>(random.Between(0, 40));
    std::vector<std::int32_t> x(count);
    std::vector<std::int32_t> y(count);
    std::vector<std::int32_t> out(count);
    std::vector<std::int32_t> expected(count);
    for (std::size_t i = 0; i < count; ++i)
    {
      x[i] = static_cast<std::int32_t>(random.Between(-32767, 32767));
      y[i] = static_cast<std::int32_t>(random.Between(-32767, 32767));
      out[i] = static_cast<std::int32_t>(random.Between(INT32_MIN, INT32_MAX));
      const std::int64_t d = std::int64_t{ x[i] } * x[i] + std::int64_t{ y[i] } * y[i];
      expected[i] = d > out[i] ? static_cast<std::int32_t>(d) : out[i];
    }
    DistancesInLanes(x.data(), y.data(), out.data(), count);
    ASSERT_EQ(out, expected) << "round " << round;
  }
}

} // namespace
} // namespace voxelcore::testing
