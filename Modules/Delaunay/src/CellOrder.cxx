#include "voxelcore/CanonicalCells.h"

#include "voxelcore/BucketSort.h"
#include "voxelcore/Error.h"
#include "voxelcore/Predicates.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <optional>

namespace voxelcore
{

namespace
{

constexpr std::size_t kAhead = 16; // places from where a loop is to what it has the memory fetch

CircumSphere
SphereOf(const DelaunayCells &             cells,
         std::uint32_t                     cell,
         const std::vector<LatticePoint> & points,
         const SpacingWeights &            weights)
{
  const auto & t = cells.tetrahedra[cell];
  return MakeCircumSphere(points[t[0]], points[t[1]], points[t[2]], points[t[3]], weights);
}

// Half of all cells lie in one voxel each, whatever its sides: their spheres have its middle.
std::optional<std::array<double, 3>>
MiddleOfVoxel(const std::array<std::uint32_t, 4> & corners, const std::vector<LatticePoint> & points)
{
  LatticePoint low = points[corners[0]];
  LatticePoint high = low;
  for (const std::uint32_t corner : { corners[1], corners[2], corners[3] })
  {
    const LatticePoint & p = points[corner];
    low = { std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z) };
    high = { std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z) };
  }
  if (high.x - low.x > 1 || high.y - low.y > 1 || high.z - low.z > 1)
  {
    return {};
  }
  return std::array<double, 3>{ low.x + 0.5, low.y + 0.5, low.z + 0.5 };
}

// Compares exact centres. Rounding is monotone, so doubles decide unless they are equal.
class CentreOrder
{
public:
  CentreOrder(const DelaunayCells & cells, const std::vector<LatticePoint> & points, const SpacingWeights & weights)
    : m_Cells(cells)
    , m_Points(points)
    , m_Weights(weights)
  {}

  int
  Compare(const CentredCell & a, const CentredCell & b) const
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      if (a.centre[axis] != b.centre[axis])
      {
        return a.centre[axis] < b.centre[axis] ? -1 : 1;
      }
      // Two fractions that round to the same v differ by at most v 2^-52, and by at least 1 / (q q') if at all.
      if (a.denominator * b.denominator * std::abs(a.centre[axis]) < 0x1p51)
      {
        continue;
      }
      const int sign = CompareCentreCoordinates(SphereOf(m_Cells, a.cell, m_Points, m_Weights),
                                                SphereOf(m_Cells, b.cell, m_Points, m_Weights),
                                                axis,
                                                m_Weights);
      if (sign != 0)
      {
        return sign;
      }
    }
    return 0;
  }

private:
  const DelaunayCells &             m_Cells;
  const std::vector<LatticePoint> & m_Points;
  const SpacingWeights &            m_Weights;
};

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

// Renumbers the cells of each facet, puts the smaller first and starts its polygon at the smallest point.
void
TurnFacets(DelaunayCells & cells, const std::vector<std::uint32_t> & rank)
{
  const std::size_t facets = cells.FacetCount();
  RunInParts(facets > 10000, facets, [&](std::size_t begin, std::size_t end) {
    for (std::size_t facet = begin; facet < end; ++facet)
    {
      if (facet + kAhead < end)
      {
        for (const std::uint32_t cell : cells.facetCells[facet + kAhead])
        {
          if (cell != kOutside)
          {
            __builtin_prefetch(&rank[cell]);
          }
        }
      }
      auto &     pair = cells.facetCells[facet];
      const auto first = cells.facetPoints.begin() + static_cast<std::ptrdiff_t>(cells.facetOffsets[facet]);
      const auto last = cells.facetPoints.begin() + static_cast<std::ptrdiff_t>(cells.facetOffsets[facet + 1]);
      if (pair[0] == kOutside)
      {
        continue;
      }
      pair[0] = rank[pair[0]];
      if (pair[1] != kOutside)
      {
        pair[1] = rank[pair[1]];
        if (pair[1] < pair[0])
        {
          std::swap(pair[0], pair[1]);
          std::reverse(first, last);
        }
      }
      std::rotate(first, std::min_element(first, last), last);
    }
  });
}

// The canonical order of facets with a cell, by buckets of their first cell. Two cells share at most one facet, so
// points need comparing only among the boundary facets of a cell: two of them share at most two points.
std::vector<std::uint32_t>
FacetOrder(const DelaunayCells & cells)
{
  struct Beyond
  {
    std::uint32_t cell;
    std::uint32_t facet;
  };
  const std::size_t                cellCount = cells.CellCount();
  std::vector<Beyond>              beyond;
  const std::vector<std::uint32_t> start = SortIntoBuckets(
    cells.FacetCount(),
    cellCount,
    [&](std::size_t facet) { return std::size_t{ cells.facetCells[facet][0] }; },
    [&](std::size_t facet) {
      return Beyond{ cells.facetCells[facet][1], static_cast<std::uint32_t>(facet) };
    },
    beyond);
  const auto isLess = [&](const Beyond & a, const Beyond & b) {
    if (a.cell != b.cell || a.cell != kOutside)
    {
      return a.cell < b.cell;
    }
    const std::uint32_t * p = cells.facetPoints.data() + cells.facetOffsets[a.facet];
    const std::uint32_t * q = cells.facetPoints.data() + cells.facetOffsets[b.facet];
    return std::lexicographical_compare(p, p + 3, q, q + 3);
  };
  std::vector<std::uint32_t> order(beyond.size());
#pragma omp parallel for schedule(static) if (cellCount > 10000)
  for (std::size_t cell = 0; cell < cellCount; ++cell)
  {
    std::sort(beyond.begin() + start[cell], beyond.begin() + start[cell + 1], isLess);
    for (std::size_t i = start[cell]; i < start[cell + 1]; ++i)
    {
      order[i] = beyond[i].facet;
    }
  }
  return order;
}

} // namespace

std::vector<CentredCell>
SortByCentre(const DelaunayCells &             cells,
             std::size_t                       firstCell,
             const std::vector<LatticePoint> & points,
             const SpacingWeights &            weights)
{
  const auto greatest = static_cast<double>(*std::max_element(weights.weight.begin(), weights.weight.end()));
  std::vector<CentredCell> entries(cells.CellCount() - firstCell);
  const auto               count = static_cast<std::ptrdiff_t>(entries.size());
  double                   low = HUGE_VAL;
  double                   high = -HUGE_VAL;
#pragma omp parallel for schedule(static) reduction(min : low) reduction(max : high) if (count > 10000)
  for (std::ptrdiff_t i = 0; i < count; ++i)
  {
    const auto    cell = static_cast<std::uint32_t>(firstCell + static_cast<std::size_t>(i));
    CentredCell & entry = entries[static_cast<std::size_t>(i)];
    if (const auto middle = MiddleOfVoxel(cells.tetrahedra[cell], points))
    {
      entry = { *middle, 2.0, cell };
    }
    else
    {
      const CircumSphere sphere = SphereOf(cells, cell, points, weights);
      entry = { { CentreCoordinate(sphere, 0, weights),
                  CentreCoordinate(sphere, 1, weights),
                  CentreCoordinate(sphere, 2, weights) },
                2.0 * static_cast<double>(sphere.det) * greatest * greatest,
                cell };
    }
    low = std::min(low, entry.centre[0]);
    high = std::max(high, entry.centre[0]);
  }

  // First into slabs of one lattice step along x, then sorted slab by slab.
  low = std::floor(low);
  const auto                 slabs = entries.empty() ? 0 : static_cast<std::size_t>(high - low) + 1;
  std::vector<std::uint32_t> slabOf(entries.size());
#pragma omp parallel for schedule(static) if (count > 10000)
  for (std::ptrdiff_t i = 0; i < count; ++i)
  {
    const auto at = static_cast<std::size_t>(i);
    slabOf[at] = static_cast<std::uint32_t>(entries[at].centre[0] - low);
  }
  std::vector<CentredCell>         order;
  const std::vector<std::uint32_t> start = SortIntoBuckets(
    entries.size(),
    slabs,
    [&](std::size_t i) { return std::size_t{ slabOf[i] }; },
    [&](std::size_t i) { return entries[i]; },
    order);
  const CentreOrder centreOrder(cells, points, weights);
  bool              twins = false;
#pragma omp parallel for schedule(dynamic) reduction(|| : twins) if (count > 10000)
  for (std::size_t slab = 0; slab < slabs; ++slab)
  {
    const auto first = order.begin() + static_cast<std::ptrdiff_t>(start[slab]);
    const auto last = order.begin() + static_cast<std::ptrdiff_t>(start[slab + 1]);
    std::sort(first, last, [&](const CentredCell & a, const CentredCell & b) { return centreOrder.Compare(a, b) < 0; });
    for (auto at = first; at != last && at + 1 != last; ++at)
    {
      twins = twins || centreOrder.Compare(*at, *(at + 1)) == 0;
    }
  }
  if (twins)
  {
    FailTwins();
  }
  return order;
}

DelaunayCells
MakeCanonical(RawCells raw, const std::vector<LatticePoint> & points, const SpacingWeights & weights)
{
  DelaunayCells & cells = raw.cells;
  {
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
    TurnFacets(cells, rank);
  }

  // One array after the other, so that never more than one of them is there twice.
  const std::vector<std::uint32_t> order = FacetOrder(cells);
  const auto                       facets = static_cast<std::ptrdiff_t>(order.size());
  std::vector<std::uint64_t>       offsets(order.size() + 1, 0);
#pragma omp parallel for schedule(static) if (facets > 10000)
  for (std::ptrdiff_t at = 0; at < facets; ++at)
  {
    const auto i = static_cast<std::size_t>(at);
    if (i + kAhead < order.size())
    {
      __builtin_prefetch(cells.facetOffsets.data() + order[i + kAhead]);
    }
    offsets[i + 1] = cells.facetOffsets[order[i] + 1] - cells.facetOffsets[order[i]];
  }
  std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
  {
    std::vector<std::uint32_t> facetPoints(offsets.back());
#pragma omp parallel for schedule(static) if (facets > 10000)
    for (std::ptrdiff_t i = 0; i < facets; ++i)
    {
      if (i + static_cast<std::ptrdiff_t>(2 * kAhead) < facets)
      {
        const std::uint32_t * ahead = order.data() + i;
        __builtin_prefetch(cells.facetOffsets.data() + ahead[2 * kAhead]);
        __builtin_prefetch(cells.facetPoints.data() + cells.facetOffsets[ahead[kAhead]]);
      }
      std::uint64_t at = offsets[static_cast<std::size_t>(i)];
      for (const std::uint32_t point : cells.FacetPoints(order[static_cast<std::size_t>(i)]))
      {
        facetPoints[at++] = point;
      }
    }
    cells.facetPoints.swap(facetPoints);
  }
  cells.facetOffsets.swap(offsets);
  std::vector<std::array<std::uint32_t, 2>> facetCells(order.size());
#pragma omp parallel for schedule(static) if (facets > 10000)
  for (std::ptrdiff_t i = 0; i < facets; ++i)
  {
    if (i + static_cast<std::ptrdiff_t>(kAhead) < facets)
    {
      __builtin_prefetch(cells.facetCells.data() + order[static_cast<std::size_t>(i) + kAhead]);
    }
    facetCells[static_cast<std::size_t>(i)] = cells.facetCells[order[static_cast<std::size_t>(i)]];
  }
  cells.facetCells.swap(facetCells);
  return std::move(cells);
}

} // namespace voxelcore
