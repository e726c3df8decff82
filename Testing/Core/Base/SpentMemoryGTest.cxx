#include "voxelcore/Base/SpentMemory.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

namespace voxelcore
{
namespace
{

using Triple = std::array<std::uint64_t, 3>; // large pages do not end between two of them

std::vector<Triple>
Counting(std::size_t count)
{
  std::vector<Triple> array(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    array[i] = { i, i + 1, i + 2 };
  }
  return array;
}

void
ExpectCountingFrom(const std::vector<Triple> & array, std::size_t first)
{
  for (std::size_t i = first; i < array.size(); ++i)
  {
    ASSERT_EQ(array[i], (Triple{ i, i + 1, i + 2 })) << i;
  }
}

TEST(SpentMemory, WhatIsNotSpentStays)
{
  for (const std::size_t count : { std::size_t{ 0 }, std::size_t{ 10 }, std::size_t{ 500'000 } })
  {
    std::vector<Triple> array = Counting(count);
    SpentFront          front(array);
    for (const std::size_t parts : { 7, 6, 5, 3, 2, 1 })
    {
      front.SpendTo(count / parts);
      front.SpendTo(count / parts / 2); // which is spent already
      ExpectCountingFrom(array, count / parts);
    }
  }
}

TEST(SpentMemory, CutShortKeepsTheFront)
{
  for (const std::size_t kept : { std::size_t{ 0 }, std::size_t{ 3 }, std::size_t{ 123'456 }, std::size_t{ 500'000 } })
  {
    std::vector<Triple> array = Counting(500'000);
    CutShort(array, kept);
    ASSERT_EQ(array.size(), kept);
    ExpectCountingFrom(array, 0);
    array.resize(500'000); // and what grows again is new
    EXPECT_EQ(array.back(), kept == 500'000 ? (Triple{ 499'999, 500'000, 500'001 }) : Triple{});
  }
}

} // namespace
} // namespace voxelcore
