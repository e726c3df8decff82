#include "voxelcore/Base/UnionFind.h"

#include "VoxelCoreTesting/Random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace voxelcore
{
namespace
{

TEST(UnionFind, SetsAreThoseOfRelabellingAndNamedByTheirSmallestElement)
{
  constexpr std::uint64_t seed = 71;
  testing::Random         random(seed);
  for (int round = 0; round < 50; ++round)
  {
    const auto                 size = static_cast<std::size_t>(random.Between(1, 60));
    UnionFind                  sets(size);
    std::vector<std::uint32_t> smallest(size); // of each element's set
    std::iota(smallest.begin(), smallest.end(), 0U);
    const std::int64_t unions = random.Between(0, 80);
    for (std::int64_t i = 0; i < unions; ++i)
    {
      const auto a = static_cast<std::size_t>(random.Between(0, static_cast<std::int64_t>(size) - 1));
      const auto b = static_cast<std::size_t>(random.Between(0, static_cast<std::int64_t>(size) - 1));
      sets.Unite(a, b);
      const auto [low, high] = std::minmax({ smallest[a], smallest[b] });
      std::replace(smallest.begin(), smallest.end(), std::uint32_t{ high }, std::uint32_t{ low });
    }
    for (std::size_t element = 0; element < size; ++element)
    {
      ASSERT_EQ(sets.Find(element), smallest[element]) << "seed " << seed << ", round " << round;
    }
    EXPECT_EQ(sets.Count(), std::set<std::uint32_t>(smallest.begin(), smallest.end()).size());
  }
}

TEST(UnionFind, OneSetOfAMillionIsFoundFromEveryElement)
{
  constexpr std::size_t size = 1000000;
  UnionFind             sets(size);
  for (std::size_t i = size - 1; i > 0; --i)
  {
    sets.Unite(i, i - 1);
  }
  EXPECT_EQ(sets.Count(), 1U);
  for (std::size_t i = 0; i < size; ++i)
  {
    ASSERT_EQ(sets.Find(i), 0U);
  }
}

} // namespace
} // namespace voxelcore
