// Fetching is harmless, wherever it points.

#include "voxelcore/Base/Prefetch.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace voxelcore::testing
{
namespace
{

TEST(Prefetch, LeavesAllAsItIsAtAnyPlace)
{
  std::vector<int> numbers(1000);
  std::iota(numbers.begin(), numbers.end(), 0);
  const std::vector<int> before = numbers;
  for (const int & number : numbers)
  {
    FetchLine(&number);
  }
  FetchLine(nullptr);
  FetchLine(numbers.data() + numbers.size());
  EXPECT_EQ(numbers, before);
}

} // namespace
} // namespace voxelcore::testing
