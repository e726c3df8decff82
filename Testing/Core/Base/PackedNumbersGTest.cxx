#include "voxelcore/Base/PackedNumbers.h"

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

TEST(PackedNumbers, RefuseWhatFillsTheirTablesTooSoon)
{
  constexpr std::size_t table = 65536;
  PackedNumbers         packed;
  EXPECT_TRUE(packed.Pack(RootsUpTo(table, table)));
  EXPECT_FALSE(packed.Pack(RootsUpTo(table + 1, table + 1)));
  std::vector<double> values(4 * table, 1.5); // the table is full with the last but one
  for (std::size_t i = 0; i < table - 1; ++i)
  {
    values[3 * table + i] = std::sqrt(static_cast<double>(i) + 3.0);
  }
  values.back() = 2.5;
  EXPECT_FALSE(packed.Pack(values)); // one too many comes too soon
  values.insert(values.begin(), 1.5);
  EXPECT_TRUE(packed.Pack(values));
}

std::vector<double>
RootsInSteps(std::size_t count, std::size_t step)
{
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i)
  {
    values.push_back(std::sqrt(static_cast<double>(i / step + i % 5)));
  }
  return values;
}

TEST(PackedNumbers, OfSeveralTablesComeBack)
{
  const std::vector<double> values = RootsInSteps(900001, 6); // 150,000 differ: three tables
  PackedNumbers             packed;
  ASSERT_TRUE(packed.Pack(values));
  std::vector<double> back(values.size());
  packed.Unpack(back);
  EXPECT_EQ(BitsOf(back), BitsOf(values));
}

TEST(PackedNumbers, OnlyThoseNamedComeBack)
{
  using Points = std::vector<std::array<double, 3>>;
  for (const std::size_t step : { 1, 6, 900000 }) // plain, of several tables, of one
  {
    const std::vector<double> values = RootsInSteps(900000, step);
    Points                    points;
    for (std::size_t i = 0; i < values.size(); i += 3)
    {
      points.push_back({ values[i], values[i + 1], values[i + 2] });
    }
    std::vector<std::uint32_t> named;
    Points                     expected;
    for (std::uint32_t i = 1; i < points.size(); i += 1 + i % 700)
    {
      named.push_back(i);
      expected.push_back(points[i]);
    }
    EXPECT_EQ(PackedArray<Points::value_type>(points).Copy(named), expected) << step;
  }
}

TEST(PackedNumbers, AreLookedUpOneByOne)
{
  for (const std::size_t different : { 200, 60000, 65537 }) // a byte, two bytes, plain
  {
    const std::vector<double> values = RootsUpTo(different, 70000);
    const PackedArray<double> packed(values);
    ASSERT_EQ(packed.IsPacked(), different < 65537);
    const std::optional<NumberView> view = packed.View();
    ASSERT_TRUE(view);
    const NumberView plain(values);
    for (std::size_t i = 0; i < values.size(); i += 101)
    {
      ASSERT_EQ((*view)[i], values[i]) << different;
      ASSERT_EQ(plain[i], values[i]);
      ASSERT_EQ(plain.Address(i), &values[i]);
    }
    const auto step = static_cast<const char *>(view->Address(7)) - static_cast<const char *>(view->Address(0));
    ASSERT_EQ(step, 7 * (different <= 256 ? 1 : different < 65537 ? 2 : 8));
  }
  EXPECT_FALSE(PackedArray<double>(RootsInSteps(900001, 6)).View()); // of several tables
}

TEST(PackedNumbers, StayAsTheyAreWhereTheyAreFew)
{
  EXPECT_FALSE(PackedArray<double>({ 1, 2, 1 }, 4).IsPacked());
  EXPECT_TRUE(PackedArray<double>({ 1, 2, 1 }, 3).IsPacked());
  EXPECT_FALSE(PackedArray<double>({ 1, 2, 1 }, 4).IsEmpty());
  EXPECT_TRUE(PackedArray<double>().IsEmpty());
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
