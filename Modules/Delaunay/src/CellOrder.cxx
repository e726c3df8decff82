#include "RawCells.h"

#include "voxelcore/Error.h"
#include "voxelcore/Predicates.h"

#include <algorithm>
#include <cmath>
#include <numeric>

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

struct Entry
{
  std::array<double, 3> centre;
  double                denominator; // of the exact coordinates, at most
  std::uint32_t         cell;
};

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
  Compare(const Entry & a, const Entry & b) const
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

// Cells by exact centre: first into slabs of one lattice step along x, then sorted slab by slab.
std::vector<Entry>
SortedCells(const DelaunayCells & cells, const std::vector<LatticePoint> & points, const SpacingWeights & weights)
{
  const auto         greatest = static_cast<double>(*std::max_element(weights.weight.begin(), weights.weight.end()));
  const auto         count = static_cast<std::ptrdiff_t>(cells.CellCount());
  std::vector<Entry> entries(cells.CellCount());
#pragma omp parallel for schedule(static) if (count > 10000)
  for (std::ptrdiff_t i = 0; i < count; ++i)
  {
    const auto         cell = static_cast<std::uint32_t>(i);
    const CircumSphere sphere = SphereOf(cells, cell, points, weights);
    entries[cell] = { { CentreCoordinate(sphere, 0, weights),
                        CentreCoordinate(sphere, 1, weights),
                        CentreCoordinate(sphere, 2, weights) },
                      2.0 * static_cast<double>(sphere.det) * greatest * greatest,
                      cell };
  }
  double low = HUGE_VAL;
  double high = -HUGE_VAL;
  for (const Entry & entry : entries)
  {
    low = std::min(low, entry.centre[0]);
    high = std::max(high, entry.centre[0]);
  }
  const auto slabOf = [&](const Entry & entry) { return static_cast<std::size_t>(entry.centre[0] - std::floor(low)); };
  const auto slabs = entries.empty() ? 0 : static_cast<std::size_t>(high - std::floor(low)) + 1;
  std::vector<std::size_t> start(slabs + 1, 0);
  for (const Entry & entry : entries)
  {
    ++start[slabOf(entry) + 1];
  }
  for (std::size_t slab = 0; slab < slabs; ++slab)
  {
    start[slab + 1] += start[slab];
  }
  std::vector<Entry> order(entries.size());
  {
    std::vector<std::size_t> next(start.begin(), start.end() - 1);
    for (const Entry & entry : entries)
    {
      order[next[slabOf(entry)]++] = entry;
    }
  }
  const CentreOrder centreOrder(cells, points, weights);
  bool              twins = false;
#pragma omp parallel for schedule(dynamic) reduction(|| : twins) if (count > 10000)
  for (std::size_t slab = 0; slab < slabs; ++slab)
  {
    const auto first = order.begin() + static_cast<std::ptrdiff_t>(start[slab]);
    const auto last = order.begin() + static_cast<std::ptrdiff_t>(start[slab + 1]);
    std::sort(first, last, [&](const Entry & a, const Entry & b) { return centreOrder.Compare(a, b) < 0; });
    for (auto at = first; at != last && at + 1 != last; ++at)
    {
      twins = twins || centreOrder.Compare(*at, *(at + 1)) == 0;
    }
  }
  if (twins)
  {
    throw CertificateError("two Delaunay cells have the same centre; please report this input");
  }
  return order;
}

// Renumbers the cells of each facet, puts the smaller first and starts its polygon at the smallest point.
void
TurnFacets(DelaunayCells & cells, const std::vector<std::uint32_t> & rank)
{
  const auto facets = static_cast<std::ptrdiff_t>(cells.FacetCount());
#pragma omp parallel for schedule(static) if (facets > 10000)
  for (std::ptrdiff_t i = 0; i < facets; ++i)
  {
    const auto facet = static_cast<std::size_t>(i);
    auto &     pair = cells.facetCells[facet];
    const auto first = cells.facetPoints.begin() + static_cast<std::ptrdiff_t>(cells.facetOffsets[facet]);
    const auto last = cells.facetPoints.begin() + static_cast<std::ptrdiff_t>(cells.facetOffsets[facet + 1]);
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
}

// The facets' canonical order, by buckets of their first cell. Two cells share at most one facet, so points need
// comparing only among the boundary facets of a cell: two of them share at most two points.
std::vector<std::uint32_t>
FacetOrder(const DelaunayCells & cells)
{
  struct Beyond
  {
    std::uint32_t cell;
    std::uint32_t facet;
  };
  const std::size_t          cellCount = cells.CellCount();
  const std::size_t          facets = cells.FacetCount();
  std::vector<std::uint32_t> start(cellCount + 2, 0);
  for (const auto & pair : cells.facetCells)
  {
    ++start[pair[0] + 2];
  }
  for (std::size_t cell = 2; cell < start.size(); ++cell)
  {
    start[cell] += start[cell - 1];
  }
  std::vector<Beyond> beyond(facets);
  for (std::size_t facet = 0; facet < facets; ++facet)
  {
    const auto & pair = cells.facetCells[facet];
    if (facet + kAhead < facets)
    {
      __builtin_prefetch(beyond.data() + start[cells.facetCells[facet + kAhead][0] + 1], 1);
    }
    beyond[start[pair[0] + 1]++] = { pair[1], static_cast<std::uint32_t>(facet) };
  }
  const auto isLess = [&](const Beyond & a, const Beyond & b) {
    if (a.cell != b.cell || a.cell != kOutside)
    {
      return a.cell < b.cell;
    }
    const std::uint32_t * p = cells.facetPoints.data() + cells.facetOffsets[a.facet];
    const std::uint32_t * q = cells.facetPoints.data() + cells.facetOffsets[b.facet];
    return std::lexicographical_compare(p, p + 3, q, q + 3);
  };
  std::vector<std::uint32_t> order(facets);
#pragma omp parallel for schedule(static) if (facets > 10000)
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

void
MakeCanonical(DelaunayCells & cells, const std::vector<LatticePoint> & points, const SpacingWeights & weights)
{
  {
    std::vector<std::uint32_t> rank(cells.CellCount());
    {
      const std::vector<Entry>                  order = SortedCells(cells, points, weights);
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
}

} // namespace voxelcore
