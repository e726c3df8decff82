#include "BrickQueue.h"

#include <gtest/gtest.h>

#include <set>

namespace voxelcore
{
namespace
{

TEST(BrickQueue, EachBrickIsTakenOnceAndItsShareIsToldEvenly)
{
  for (const std::size_t first : { 0U, 1U, 700U })
  {
    constexpr std::size_t count = 40;
    BrickQueue            queue(first, first + count);
    std::set<std::size_t> taken;
    for (std::size_t i = 0; i < count; ++i)
    {
      EXPECT_NEAR(queue.ShareTaken(), static_cast<double>(i) / count, 1e-12) << first;
      const std::size_t brick = queue.Take(i % 3 == 0);
      EXPECT_TRUE(brick >= first && brick < first + count);
      EXPECT_TRUE(taken.insert(brick).second) << brick;
    }
    EXPECT_EQ(queue.ShareTaken(), 1);
    EXPECT_EQ(queue.Take(true), BrickQueue::none);
    EXPECT_EQ(queue.Take(false), BrickQueue::none);
  }
}

} // namespace
} // namespace voxelcore
