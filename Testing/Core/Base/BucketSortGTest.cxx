#include "voxelcore/Base/BucketSort.h"

#include "VoxelCoreTesting/Threads.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>

namespace voxelcore
{
namespace
{

TEST(SortIntoBuckets, AgreesWithAStableSortForAnyThreadsAndLeavesOutWhatHasNoBucket)
{
  constexpr unsigned seed = 20261121;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  for (const std::size_t items : { 0U, 1U, 300U, 30000U })
  {
    for (const std::size_t buckets : { 1U, 2U, 97U, 50000U })
    {
      // A twentieth, and whatever is asked beyond the last bucket, belongs nowhere.
      std::vector<std::size_t> bucketOf(items);
      for (std::size_t & bucket : bucketOf)
      {
        bucket = random() % 20 == 0 ? ~std::size_t{ 0 } : random() % (buckets + buckets / 7 + 1);
      }
      std::vector<std::uint32_t> expected;
      for (std::size_t item = 0; item < items; ++item)
      {
        if (bucketOf[item] < buckets)
        {
          expected.push_back(static_cast<std::uint32_t>(item));
        }
      }
      std::stable_sort(expected.begin(), expected.end(), [&](std::uint32_t a, std::uint32_t b) {
        return bucketOf[a] < bucketOf[b];
      });
      for (const int threads : { 1, 2, 5 })
      {
        const testing::Threads           scope(threads);
        std::vector<std::uint32_t>       sorted;
        const std::vector<std::uint32_t> start = SortIntoBuckets(
          items,
          buckets,
          [&](std::size_t item) { return bucketOf[item]; },
          [](std::size_t item) { return static_cast<std::uint32_t>(item); },
          sorted);
        ASSERT_EQ(sorted, expected) << items << " items, " << buckets << " buckets, " << threads << " threads";
        ASSERT_EQ(start.size(), buckets + 1);
        ASSERT_EQ(start.back(), sorted.size());
        for (std::size_t bucket = 0; bucket < buckets; ++bucket)
        {
          for (std::uint32_t at = start[bucket]; at < start[bucket + 1]; ++at)
          {
            ASSERT_EQ(bucketOf[sorted[at]], bucket);
          }
        }
        // Each bucket backwards: as a whole, what it was from its end to its start.
        std::vector<std::uint32_t> backwards = sorted;
        SortEachBucket(start, backwards, std::greater<>());
        for (std::size_t bucket = 0; bucket < buckets; ++bucket)
        {
          std::reverse(sorted.begin() + start[bucket], sorted.begin() + start[bucket + 1]);
        }
        ASSERT_EQ(backwards, sorted);
      }
    }
  }
}

} // namespace
} // namespace voxelcore
