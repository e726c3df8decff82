#include "PackedNumbers.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace voxelcore
{
namespace
{

std::vector<std::uint64_t>
BitsOf(const std::vector<double> & values)
{
  std::vector<std::uint64_t> bits;
  for (const double value : values)
  {
    bits.push_back(std::bit_cast<std::uint64_t>(value));
  }
  return bits;
}

std::vector<double>
RootsUpTo(std::size_t different, std::size_t count)
{
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i)
  {
    values.push_back(std::sqrt(static_cast<double>(i * 7919 % different)));
  }
  return values;
}

TEST(PackedNumbers, ComeBackToTheLastBit)
{
  const std::vector<double> values{ 0.0,
                                    -0.0,
                                    std::sqrt(2.0),
                                    std::nextafter(std::sqrt(2.0), 2.0),
                                    std::numeric_limits<double>::infinity(),
                                    std::numeric_limits<double>::denorm_min(),
                                    0.0 };
  EXPECT_EQ(BitsOf(PackedArray<double>(values).Take()), BitsOf(values));
}

TEST(PackedNumbers, ComeBackHoweverManyDiffer)
{
  for (const std::size_t different : { 1, 255, 256, 257, 65535, 65536, 65537, 100000 })
  {
    const std::vector<double> values = RootsUpTo(different, 100003);
    PackedArray<double>       packed(values);
    EXPECT_EQ(packed.Copy(), values) << different;
    EXPECT_EQ(std::move(packed).Take(), values) << different;
  }
}

TEST(PackedNumbers, RefuseMoreThanTwoBytesTell)
{
  PackedNumbers packed;
  EXPECT_TRUE(packed.Pack(RootsUpTo(65536, 65536)));
  EXPECT_FALSE(packed.Pack(RootsUpTo(65537, 65537)));
}

TEST(PackedNumbers, OfPointsComeBackInOrder)
{
  const std::vector<std::array<double, 3>> points{ { 1, 2.5, 3 }, { 2.5, 1, 1 }, { 0.1, 0.2, 0.3 } };
  EXPECT_EQ((PackedArray<std::array<double, 3>>(points).Take()), points);
}

TEST(PackedNumbers, OfNothingAreNone)
{
  EXPECT_TRUE(PackedArray<double>().Take().empty());
  EXPECT_TRUE(PackedArray<double>(std::vector<double>()).Take().empty());
  EXPECT_TRUE((PackedArray<std::array<double, 3>>(std::vector<std::array<double, 3>>()).Copy().empty()));
}

} // namespace
} // namespace voxelcore
