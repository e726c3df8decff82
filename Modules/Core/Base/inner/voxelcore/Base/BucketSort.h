#pragma once
// Counting sort, side by side.

#include "voxelcore/Base/ParallelTasks.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace voxelcore
{

/** Sorts items 0 .. items - 1 by bucketOf(item), stable; an item of a bucket beyond the last is left out, and up to
 *  2^32 - 1 are not. Puts valueOf(item) for each into `sorted` and returns where each bucket starts there, with the end
 *  behind. Both functions are called from several threads, bucketOf more than once an item. */
template <typename TBucketOf, typename TValueOf, typename TValue>
std::vector<std::uint32_t>
SortIntoBuckets(std::size_t           items,
                std::size_t           buckets,
                TBucketOf             bucketOf,
                TValueOf              valueOf,
                std::vector<TValue> & sorted)
{
  constexpr std::size_t ahead = 16; // items
  const bool            worthIt = items > 10000;
  // While items are counted, the number of a bucket's stands two places behind, so that after laying them down, which
  // moves the place before, each start is where it belongs.
  std::vector<std::uint32_t> start(buckets + 2, 0);
  // Each part of the buckets looks at all items, in order: what it writes stays near, and does not depend on the parts.
  RunInParts(worthIt, buckets, [&](std::size_t first, std::size_t last) {
    for (std::size_t item = 0; item < items; ++item)
    {
      const std::size_t bucket = bucketOf(item);
      if (bucket - first < last - first)
      {
        ++start[bucket + 2];
      }
    }
  });
  for (std::size_t bucket = 2; bucket < start.size(); ++bucket)
  {
    start[bucket] += start[bucket - 1];
  }
  sorted.resize(start.back());
  RunInParts(worthIt, buckets, [&](std::size_t first, std::size_t last) {
    for (std::size_t item = 0; item < items; ++item)
    {
      if (item + ahead < items)
      {
        const std::size_t next = bucketOf(item + ahead);
        if (next - first < last - first)
        {
          __builtin_prefetch(sorted.data() + start[next + 1], 1);
        }
      }
      const std::size_t bucket = bucketOf(item);
      if (bucket - first < last - first)
      {
        sorted[start[bucket + 1]++] = valueOf(item);
      }
    }
  });
  start.pop_back();
  return start;
}

/** Sorts what SortIntoBuckets() put into each bucket. isLess is called from several threads. */
template <typename TValue, typename TLess>
void
SortEachBucket(const std::vector<std::uint32_t> & start, std::vector<TValue> & sorted, TLess isLess)
{
  const std::size_t buckets = start.size() - 1;
  RunInParts(buckets > 10000, buckets, [&](std::size_t first, std::size_t last) {
    for (std::size_t bucket = first; bucket < last; ++bucket)
    {
      std::sort(sorted.begin() + start[bucket], sorted.begin() + start[bucket + 1], isLess);
    }
  });
}

} // namespace voxelcore
