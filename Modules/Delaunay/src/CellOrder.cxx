#include "RawCells.h"

#include "voxelcore/Error.h"
#include "voxelcore/Predicates.h"

#include <algorithm>
#include <tuple>

namespace voxelcore
{

namespace
{

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

// Cells by exact centre. Rounding is monotone, so doubles decide unless they are equal.
std::vector<Entry>
SortedCells(const DelaunayCells & cells, const std::vector<LatticePoint> & points, const SpacingWeights & weights)
{
  const auto         greatest = static_cast<double>(*std::max_element(weights.weight.begin(), weights.weight.end()));
  std::vector<Entry> order(cells.CellCount());
#pragma omp parallel for schedule(static) if (order.size() > 10000)
  for (std::size_t cell = 0; cell < order.size(); ++cell)
  {
    const auto         index = static_cast<std::uint32_t>(cell);
    const CircumSphere sphere = SphereOf(cells, index, points, weights);
    order[cell] = { { CentreCoordinate(sphere, 0, weights),
                      CentreCoordinate(sphere, 1, weights),
                      CentreCoordinate(sphere, 2, weights) },
                    2.0 * static_cast<double>(sphere.det) * greatest * greatest,
                    index };
  }
  const auto compare = [&](const Entry & a, const Entry & b) {
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
      const int sign = CompareCentreCoordinates(SphereOf(cells, a.cell, points, weights),
                                                SphereOf(cells, b.cell, points, weights),
                                                axis,
                                                weights);
      if (sign != 0)
      {
        return sign;
      }
    }
    return 0;
  };
  std::sort(order.begin(), order.end(), [&](const Entry & a, const Entry & b) { return compare(a, b) < 0; });
  for (std::size_t i = 1; i < order.size(); ++i)
  {
    if (compare(order[i - 1], order[i]) == 0)
    {
      throw CertificateError("two Delaunay cells have the same centre; please report this input");
    }
  }
  return order;
}

} // namespace

void
MakeCanonical(DelaunayCells & cells, const std::vector<LatticePoint> & points, const SpacingWeights & weights)
{
  std::vector<std::uint32_t> rank(cells.CellCount());
  {
    const std::vector<Entry>                  order = SortedCells(cells, points, weights);
    std::vector<std::array<std::uint32_t, 4>> tetrahedra(order.size());
    cells.centres.resize(order.size());
    for (std::size_t i = 0; i < order.size(); ++i)
    {
      rank[order[i].cell] = static_cast<std::uint32_t>(i);
      cells.centres[i] = order[i].centre;
      tetrahedra[i] = cells.tetrahedra[order[i].cell];
    }
    cells.tetrahedra.swap(tetrahedra);
  }

  const std::size_t          facets = cells.FacetCount();
  std::vector<std::uint64_t> bucketEnd(cells.CellCount() + 1, 0);
  for (std::size_t facet = 0; facet < facets; ++facet)
  {
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
    ++bucketEnd[pair[0] + 1];
  }
  for (std::size_t cell = 0; cell < cells.CellCount(); ++cell)
  {
    bucketEnd[cell + 1] += bucketEnd[cell];
  }
  std::vector<std::uint32_t> order(facets);
  {
    std::vector<std::uint64_t> next(bucketEnd.begin(), bucketEnd.end() - 1);
    for (std::size_t facet = 0; facet < facets; ++facet)
    {
      order[next[cells.facetCells[facet][0]]++] = static_cast<std::uint32_t>(facet);
    }
  }
  const auto key = [&](std::uint32_t facet) {
    const std::uint32_t * p = cells.facetPoints.data() + cells.facetOffsets[facet];
    return std::make_tuple(cells.facetCells[facet][1], p[0], p[1], p[2]); // two facets of a cell share two points
  };
#pragma omp parallel for schedule(static) if (order.size() > 10000)
  for (std::size_t cell = 0; cell < cells.CellCount(); ++cell)
  {
    std::sort(order.begin() + static_cast<std::ptrdiff_t>(bucketEnd[cell]),
              order.begin() + static_cast<std::ptrdiff_t>(bucketEnd[cell + 1]),
              [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  }

  std::vector<std::array<std::uint32_t, 2>> facetCells(facets);
  std::vector<std::uint64_t>                offsets(facets + 1, 0);
  std::vector<std::uint32_t>                facetPoints(cells.facetPoints.size());
  for (std::size_t i = 0; i < facets; ++i)
  {
    const auto from = cells.FacetPoints(order[i]);
    facetCells[i] = cells.facetCells[order[i]];
    offsets[i + 1] = offsets[i] + from.size();
    std::copy(from.begin(), from.end(), facetPoints.begin() + static_cast<std::ptrdiff_t>(offsets[i]));
  }
  cells.facetCells.swap(facetCells);
  cells.facetOffsets.swap(offsets);
  cells.facetPoints.swap(facetPoints);
}

} // namespace voxelcore
