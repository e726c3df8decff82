#include "voxelcore/Delaunay/CanonicalCells.h"

#include "CentreBuckets.h"
#include "FacetOrder.h"
#include "VoxelSides.h"

#include "voxelcore/Base/BucketSort.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Lattice/Predicates.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <numeric>
#include <span>

namespace voxelcore
{

namespace
{

constexpr std::size_t kAhead = 16; // places from where a loop is to what it has the memory fetch
constexpr std::size_t kRuns = 16;  // of cells in order, of which one is at hand at a time

using CentredRun = std::span<const CentredCell>;

[[noreturn]] void
FailTwins()
{
  throw CertificateError("two Delaunay cells have the same centre; please report this input");
}

/** Calls visit for one run after the other of the cells, by exact centre. */
void
VisitByCentre(const DelaunayCells &                   cells,
              const std::vector<LatticePoint> &       points,
              const SpacingWeights &                  weights,
              const std::function<void(CentredRun)> & visit)
{
  const std::size_t          count = cells.CellCount();
  const bool                 worthIt = count > 10000;
  const CentreBuckets        buckets(cells, points, weights, count);
  std::vector<std::uint32_t> bucketOf(count);
  RunInParts(worthIt, count, [&](std::size_t first, std::size_t last) {
    std::array<std::uint32_t, 256> list;
    std::array<CentredCell, 256>   centred;
    for (std::size_t begin = first; begin < last; begin += list.size())
    {
      const std::size_t some = std::min(list.size(), last - begin);
      std::iota(list.begin(), list.end(), static_cast<std::uint32_t>(begin));
      CentresOf(cells, std::span(list).first(some), points, weights, centred.data());
      for (std::size_t i = 0; i < some; ++i)
      {
        bucketOf[begin + i] = buckets.Of(centred[i]);
      }
    }
  });
  std::vector<std::uint32_t>       order;
  const std::vector<std::uint32_t> start = SortIntoBuckets(
    count,
    buckets.Count(),
    [&](std::size_t i) { return std::size_t{ bucketOf[i] }; },
    [&](std::size_t i) { return static_cast<std::uint32_t>(i); },
    order);
  bucketOf = {};
  const CentreOrder centreOrder(cells, points, weights);
  std::atomic<bool> twins = false;
  const auto isLess = [&](const CentredCell & a, const CentredCell & b) { return centreOrder.Compare(a, b) < 0; };
  std::vector<CentredCell> run;
  for (std::size_t step = 0; step < kRuns; ++step)
  {
    const auto bucketAt = [&](std::size_t share) {
      const auto atLeast = static_cast<std::uint32_t>(count * share / kRuns);
      return static_cast<std::size_t>(std::lower_bound(start.begin(), start.end(), atLeast) - start.begin());
    };
    const std::size_t begin = bucketAt(step);
    const std::size_t end = step + 1 == kRuns ? buckets.Count() : bucketAt(step + 1);
    run.resize(start[end] - start[begin]);
    RunInParts(run.size() > 10000, end - begin, [&](std::size_t firstBucket, std::size_t lastBucket) {
      const std::size_t from = start[begin + firstBucket];
      CentresOf(cells,
                std::span(order).subspan(from, start[begin + lastBucket] - from),
                points,
                weights,
                run.data() + (from - start[begin]));
      for (std::size_t bucket = begin + firstBucket; bucket < begin + lastBucket; ++bucket)
      {
        const auto first = run.begin() + static_cast<std::ptrdiff_t>(start[bucket] - start[begin]);
        const auto last = run.begin() + static_cast<std::ptrdiff_t>(start[bucket + 1] - start[begin]);
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
    visit(run);
  }
}

/** Numbers cells in their order, as they come run after run. */
class CanonicalOrder
{
public:
  CanonicalOrder(DelaunayCells & cells, bool writesCentres)
    : m_Cells(cells)
    , m_WritesCentres(writesCentres)
    , m_Rank(cells.CellCount())
    , m_Tetrahedra(cells.CellCount())
    , m_VoxelSides(cells.voxelSides.size())
  {
    cells.centres.resize(writesCentres ? cells.CellCount() : 0);
  }

  void
  Take(CentredRun run)
  {
    RunInParts(run.size() > 10000, run.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i)
      {
        const std::uint32_t ahead = run[std::min(i + kAhead, last - 1)].cell;
        __builtin_prefetch(m_Rank.data() + ahead, 1);
        __builtin_prefetch(m_Cells.tetrahedra.data() + ahead);
        const std::uint32_t cell = run[i].cell;
        const std::size_t   number = m_Numbered + i;
        m_Rank[cell] = static_cast<std::uint32_t>(number);
        if (m_WritesCentres)
        {
          m_Cells.centres[number] = run[i].centre;
        }
        m_Tetrahedra[number] = m_Cells.tetrahedra[cell];
        if (!m_VoxelSides.empty())
        {
          m_VoxelSides[number] = m_Cells.voxelSides[cell];
        }
      }
    });
    m_Numbered += run.size();
  }

  /** Nothing more will come. \returns what number each cell has now */
  std::vector<std::uint32_t>
  Finish()
  {
    m_Cells.tetrahedra.swap(m_Tetrahedra);
    m_Cells.voxelSides.swap(m_VoxelSides);
    return std::move(m_Rank);
  }

private:
  DelaunayCells &                           m_Cells;
  bool                                      m_WritesCentres;
  std::vector<std::uint32_t>                m_Rank;
  std::vector<std::array<std::uint32_t, 4>> m_Tetrahedra;
  std::vector<std::uint8_t>                 m_VoxelSides;
  std::size_t                               m_Numbered = 0;
};

} // namespace

std::vector<std::uint32_t>
SortByCentre(const DelaunayCells & cells, const std::vector<LatticePoint> & points, const SpacingWeights & weights)
{
  std::vector<std::uint32_t> order;
  order.reserve(cells.CellCount());
  VisitByCentre(cells, points, weights, [&](CentredRun run) {
    ranges::transform(run, std::back_inserter(order), &CentredCell::cell);
  });
  return order;
}

DelaunayCells
MakeCanonical(DelaunayCells                     cells,
              const std::vector<LatticePoint> & points,
              const SpacingWeights &            weights,
              Facets                            facets)
{
  if (facets == Facets::Inside)
  {
    NoteBoundary(points, weights, cells); // OrderFacets() leaves out what has no cell
  }
  std::vector<std::uint32_t> rank;
  {
    CanonicalOrder order(cells, facets == Facets::All);
    VisitByCentre(cells, points, weights, [&](CentredRun run) { order.Take(run); });
    rank = order.Finish();
  }
  OrderFacets(cells, std::move(rank));
  return cells;
}

} // namespace voxelcore
