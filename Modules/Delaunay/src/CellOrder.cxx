#include "voxelcore/CanonicalCells.h"

#include "CentreBuckets.h"
#include "FacetOrder.h"

#include "voxelcore/BucketSort.h"
#include "voxelcore/Error.h"
#include "voxelcore/Predicates.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace voxelcore
{

namespace
{

constexpr std::size_t kAhead = 16; // places from where a loop is to what it has the memory fetch

[[noreturn]] void
FailTwins()
{
  throw CertificateError("two Delaunay cells have the same centre; please report this input");
}

// Two lists in order, in one.
std::vector<CentredCell>
MergeSorted(std::vector<CentredCell> a, std::vector<CentredCell> b, const CentreOrder & order)
{
  std::vector<CentredCell> merged(a.size() + b.size());
  std::atomic<bool>        twins = false;
  const auto isLess = [&](const CentredCell & x, const CentredCell & y) { return order.Compare(x, y) < 0; };
  const auto partnerOf = [&](std::size_t i) {
    return i == a.size() ? b.end() : i == 0 ? b.begin() : std::lower_bound(b.begin(), b.end(), a[i], isLess);
  };
  RunInParts(merged.size() > 10000, a.size(), [&](std::size_t first, std::size_t last) {
    const auto from = partnerOf(first);
    const auto to = partnerOf(last);
    const auto at = [](auto & list, std::size_t i) { return list.begin() + static_cast<std::ptrdiff_t>(i); };
    const auto begin = at(merged, first + static_cast<std::size_t>(from - b.begin()));
    const auto end = std::merge(at(a, first), at(a, last), from, to, begin, isLess);
    if (std::adjacent_find(begin, end, [&](const CentredCell & x, const CentredCell & y) {
          return order.Compare(x, y) == 0;
        }) != end)
    {
      twins = true;
    }
  });
  if (twins)
  {
    FailTwins();
  }
  return merged;
}

} // namespace

std::vector<CentredCell>
SortByCentre(const DelaunayCells &             cells,
             std::size_t                       firstCell,
             const std::vector<LatticePoint> & points,
             const SpacingWeights &            weights)
{
  std::vector<CentredCell> entries(cells.CellCount() - firstCell);
  const std::size_t        count = entries.size();
  CentreBuckets            buckets(cells, points, weights);
  RunInParts(count > 10000, count, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
    {
      entries[i] = CentreOf(cells, static_cast<std::uint32_t>(firstCell + i), points, weights);
    }
  });
  buckets.Divide(entries);
  std::vector<std::uint32_t> bucketOf(count);
  RunInParts(count > 10000, count, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
    {
      bucketOf[i] = buckets.Of(entries[i]);
    }
  });
  std::vector<CentredCell>         order;
  const std::vector<std::uint32_t> start = SortIntoBuckets(
    count,
    buckets.Count(),
    [&](std::size_t i) { return std::size_t{ bucketOf[i] }; },
    [&](std::size_t i) { return entries[i]; },
    order);
  entries = {};
  bucketOf = {};
  const CentreOrder centreOrder(cells, points, weights);
  std::atomic<bool> twins = false;
  RunInParts(count > 10000, buckets.Count(), [&](std::size_t firstBucket, std::size_t lastBucket) {
    const auto isLess = [&](const CentredCell & a, const CentredCell & b) { return centreOrder.Compare(a, b) < 0; };
    for (std::size_t bucket = firstBucket; bucket < lastBucket; ++bucket)
    {
      const auto first = order.begin() + static_cast<std::ptrdiff_t>(start[bucket]);
      const auto last = order.begin() + static_cast<std::ptrdiff_t>(start[bucket + 1]);
      // Most are short, and nearly in order.
      std::sort(first, last, isLess);
      for (auto at = first; at != last && at + 1 != last; ++at)
      {
        if (centreOrder.Compare(*at, *(at + 1)) == 0)
        {
          twins = true;
        }
      }
    }
  });
  if (twins)
  {
    FailTwins();
  }
  return order;
}

DelaunayCells
MakeCanonical(RawCells raw, const std::vector<LatticePoint> & points, const SpacingWeights & weights)
{
  DelaunayCells &            cells = raw.cells;
  std::vector<std::uint32_t> rank(cells.CellCount());
  {
    std::vector<CentredCell> order = SortByCentre(cells, raw.sorted.size(), points, weights);
    if (!raw.sorted.empty())
    {
      order = MergeSorted(std::move(raw.sorted), std::move(order), CentreOrder(cells, points, weights));
    }
    std::vector<std::array<std::uint32_t, 4>> tetrahedra(order.size());
    cells.centres.resize(order.size());
    const auto count = static_cast<std::ptrdiff_t>(order.size());
#pragma omp parallel for schedule(static) if (count > 10000)
    for (std::ptrdiff_t at = 0; at < count; ++at)
    {
      const auto i = static_cast<std::size_t>(at);
      if (i + kAhead < order.size())
      {
        __builtin_prefetch(rank.data() + order[i + kAhead].cell, 1);
        __builtin_prefetch(cells.tetrahedra.data() + order[i + kAhead].cell);
      }
      rank[order[i].cell] = static_cast<std::uint32_t>(i);
      cells.centres[i] = order[i].centre;
      tetrahedra[i] = cells.tetrahedra[order[i].cell];
    }
    cells.tetrahedra.swap(tetrahedra);
  }
  OrderFacets(cells, std::move(rank));
  return std::move(cells);
}

} // namespace voxelcore
