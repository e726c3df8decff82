#include "voxelcore/BucketQueue.h"

#include "VoxelCoreTesting/Random.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <tuple>

namespace voxelcore
{
namespace
{

struct Item
{
  double        key;
  std::uint32_t number;

  double
  Key() const
  {
    return key;
  }
  friend bool
  operator<(const Item & a, const Item & b)
  {
    return std::tie(a.key, a.number) < std::tie(b.key, b.number);
  }
};

/** What waits is the key alone; its number is found when it is next. */
struct Waiting
{
  float         key;
  std::uint32_t number;

  double
  Key() const
  {
    return key;
  }
};

struct Wake
{
  Item
  operator()(const Waiting & waiting) const
  {
    return { waiting.key, waiting.number };
  }
};

/** Fills and empties a queue in random order beside a sorted set, with keys of which many are equal and some lie beyond
 *  the bounds. */
template <typename Queue, typename In>
void
ExpectSortedOrder(std::uint64_t seed)
{
  testing::Random random(seed);
  for (int round = 0; round < 30; ++round)
  {
    Queue          queue(10, round == 0 ? 10 : 20);
    std::set<Item> all;
    std::uint32_t  number = 0;
    for (int step = 0; step < 2000; ++step)
    {
      if (random.Chance(step < 1000 ? 0.7 : 0.2))
      {
        const auto key = static_cast<float>(random.Between(32, 88)) / 4;
        queue.Push(In{ key, ++number });
        all.insert({ key, number });
      }
      else if (!all.empty())
      {
        ASSERT_TRUE(queue.Prepare());
        ASSERT_EQ(queue.Top().number, all.begin()->number) << "seed " << seed << ", round " << round;
        ASSERT_EQ(queue.Pop().number, all.begin()->number) << "seed " << seed << ", round " << round;
        all.erase(all.begin());
      }
    }
    for (; !all.empty(); all.erase(all.begin()))
    {
      ASSERT_TRUE(queue.Prepare());
      ASSERT_EQ(queue.Pop().number, all.begin()->number) << "seed " << seed << ", round " << round;
    }
    EXPECT_FALSE(queue.Prepare());
  }
}

TEST(BucketQueue, GivesTheSmallestOfWhatIsThere)
{
  ExpectSortedOrder<BucketQueue<Item>, Item>(17);
}

TEST(BucketQueue, WhatWaitsMayBeSmaller)
{
  ExpectSortedOrder<BucketQueue<Item, Waiting, Wake>, Waiting>(18);
}

TEST(BucketQueue, AheadIsWhatComesWhenNothingArrives)
{
  BucketQueue<Item> queue(0, 1024 * 1024);
  for (std::uint32_t number = 0; number < 100; ++number)
  {
    queue.Push({ static_cast<double>(number * 37 % 100), number }); // all in one bucket
  }
  ASSERT_TRUE(queue.Prepare());
  std::vector<std::uint32_t> ahead;
  for (std::size_t steps = 0; queue.Ahead(steps); ++steps)
  {
    ahead.push_back(queue.Ahead(steps)->number);
  }
  ASSERT_EQ(ahead.size(), 100U);
  for (const std::uint32_t number : ahead)
  {
    EXPECT_EQ(queue.Pop().number, number);
  }
}

} // namespace
} // namespace voxelcore
