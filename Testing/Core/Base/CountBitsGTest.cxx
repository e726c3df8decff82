#include "voxelcore/Base/CountBits.h"

#include <gtest/gtest.h>

#include <bit>
#include <iostream>
#include <random>

namespace voxelcore
{
namespace
{

TEST(CountBits, CountsAllRunsOfOnes)
{
  EXPECT_EQ(CountBits(0), 0U);
  for (unsigned length = 1; length <= 64; ++length)
  {
    const std::uint64_t ones = ~std::uint64_t{ 0 } >> (64 - length);
    for (unsigned first = 0; first + length <= 64; ++first)
    {
      ASSERT_EQ(CountBits(ones << first), length) << "from bit " << first;
    }
  }
}

TEST(CountBits, CountsAsTheStandardDoes)
{
  const auto seed = std::random_device{}();
  std::cout << "seed " << seed << "\n";
  std::mt19937_64 random(seed);
  for (int i = 0; i < 100000; ++i)
  {
    const std::uint64_t word = random();
    ASSERT_EQ(static_cast<int>(CountBits(word)), std::popcount(word)) << "seed " << seed << ", word " << word;
  }
}

} // namespace
} // namespace voxelcore
