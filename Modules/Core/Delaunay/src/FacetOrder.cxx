#include "FacetOrder.h"

#include "voxelcore/Base/BucketSort.h"

#include <omp.h>

#include <algorithm>
#include <functional>

namespace voxelcore
{

namespace
{

constexpr std::size_t kFacetsAhead = 16; // places from where a loop is to what it has the memory fetch

// A facet under its first cell: its second cell, and its number, later that of its points. In the end the two cells.
using FacetBeyond = std::array<std::uint32_t, 2>;

// What one thread puts down.
struct FacetPart
{
  std::size_t   firstCell = 0;
  std::size_t   lastCell = 0;
  std::uint64_t firstPoint = 0;
  std::uint64_t points = 0;
};

// Renumbers the cells of each facet and puts the smaller first. \returns a bit a facet: whether they changed places, so
// that its polygon has to be turned round.
std::vector<std::uint64_t>
RenumberCells(DelaunayCells & cells, const std::vector<std::uint32_t> & rank)
{
  const std::size_t          facets = cells.FacetCount();
  std::vector<std::uint64_t> turned((facets + 63) / 64, 0);
  RunInParts(facets > 10000, turned.size(), [&](std::size_t firstWord, std::size_t lastWord) {
    for (std::size_t word = firstWord; word < lastWord; ++word)
    {
      for (std::size_t facet = 64 * word; facet < std::min(64 * word + 64, facets); ++facet)
      {
        auto & pair = cells.facetCells[facet];
        if (pair[0] == kOutside)
        {
          continue;
        }
        pair[0] = rank[pair[0]];
        if (pair[1] != kOutside)
        {
          pair[1] = rank[pair[1]];
          const bool turn = pair[1] < pair[0];
          pair = { turn ? pair[1] : pair[0], turn ? pair[0] : pair[1] };
          turned[word] |= std::uint64_t{ turn } << facet % 64;
        }
      }
    }
  });
  return turned;
}

// The first points of a boundary facet as its polygon will start.
std::array<std::uint32_t, 3>
FirstPoints(const DelaunayCells & cells, std::uint32_t facet)
{
  const auto        polygon = cells.FacetPoints(facet);
  const std::size_t least =
    static_cast<std::size_t>(std::min_element(polygon.begin(), polygon.end()) - polygon.begin());
  return { polygon[least], polygon[(least + 1) % polygon.size()], polygon[(least + 2) % polygon.size()] };
}

// Two cells share at most one facet, so points need comparing only among the boundary facets of a cell: two of them
// share at most two points.
void
SortFacetsOfCell(const DelaunayCells & cells, std::span<FacetBeyond> own)
{
  for (std::size_t i = 1; i < own.size(); ++i)
  {
    const FacetBeyond moved = own[i];
    const auto        isBefore = [&](const FacetBeyond & other) {
      return moved[0] < other[0] || (moved[0] == kOutside && other[0] == kOutside &&
                                     FirstPoints(cells, moved[1]) < FirstPoints(cells, other[1]));
    };
    std::size_t at = i;
    for (; at > 0 && isBefore(own[at - 1]); --at)
    {
      own[at] = own[at - 1];
    }
    own[at] = moved;
  }
}

// A polygon from its smallest point on, turned round or not.
void
CopyPolygon(std::span<const std::uint32_t> polygon, bool turn, std::uint32_t * to)
{
  std::size_t least = 0;
  for (std::size_t i = 1; i < polygon.size(); ++i)
  {
    least = polygon[i] < polygon[least] ? i : least;
  }
  const std::size_t step = turn ? polygon.size() - 1 : 1;
  for (std::size_t i = 0, at = least; i < polygon.size(); ++i)
  {
    to[i] = polygon[at];
    at += step;
    at = at >= polygon.size() ? at - polygon.size() : at;
  }
}

} // namespace

void
OrderFacets(DelaunayCells & cells, std::vector<std::uint32_t> rank)
{
  const std::size_t                cellCount = rank.size();
  const std::vector<std::uint64_t> turned = RenumberCells(cells, rank);
  rank = {};
  std::vector<FacetBeyond>         order;
  const std::vector<std::uint32_t> start = SortIntoBuckets(
    cells.FacetCount(),
    cellCount,
    [&](std::size_t facet) { return std::size_t{ cells.facetCells[facet][0] }; },
    [&](std::size_t facet) {
      return FacetBeyond{ cells.facetCells[facet][1], static_cast<std::uint32_t>(facet) };
    },
    order);
  // `order` knows the cells of its facets by now, and becomes the list of them.
  std::vector<std::array<std::uint32_t, 2>>().swap(cells.facetCells);
  const std::size_t      facets = order.size();
  const bool             worthIt = facets > 10000;
  std::vector<FacetPart> parts(worthIt ? static_cast<std::size_t>(omp_get_max_threads()) : 1);
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    parts[i].firstCell = cellCount * i / parts.size();
    parts[i].lastCell = cellCount * (i + 1) / parts.size();
  }
  const auto forEachPart = [&](const std::function<void(FacetPart &)> & work) {
    RunInParts(worthIt, parts.size(), [&](std::size_t first, std::size_t last) {
      std::for_each(parts.begin() + static_cast<std::ptrdiff_t>(first),
                    parts.begin() + static_cast<std::ptrdiff_t>(last),
                    work);
    });
  };
  forEachPart([&](FacetPart & part) {
    const std::size_t end = start[part.lastCell]; // what lies beyond is being changed
    for (std::size_t cell = part.firstCell; cell < part.lastCell; ++cell)
    {
      SortFacetsOfCell(cells, { order.data() + start[cell], order.data() + start[cell + 1] });
      for (std::size_t i = start[cell]; i < start[cell + 1]; ++i)
      {
        if (i + kFacetsAhead < end)
        {
          __builtin_prefetch(cells.facetOffsets.data() + order[i + kFacetsAhead][1]);
        }
        part.points += cells.FacetPoints(order[i][1]).size();
      }
    }
  });
  for (std::size_t i = 1; i < parts.size(); ++i)
  {
    parts[i].firstPoint = parts[i - 1].firstPoint + parts[i - 1].points;
  }
  std::vector<std::uint32_t> facetPoints(parts.back().firstPoint + parts.back().points);
  forEachPart([&](const FacetPart & part) {
    std::uint32_t *   to = facetPoints.data() + part.firstPoint;
    const std::size_t end = start[part.lastCell];
    for (std::size_t i = start[part.firstCell]; i < end; ++i)
    {
      if (i + 2 * kFacetsAhead < end)
      {
        __builtin_prefetch(cells.facetOffsets.data() + order[i + 2 * kFacetsAhead][1]);
        __builtin_prefetch(cells.facetPoints.data() + cells.facetOffsets[order[i + kFacetsAhead][1]]);
      }
      const std::uint32_t facet = order[i][1];
      const auto          polygon = cells.FacetPoints(facet);
      CopyPolygon(polygon, (turned[facet / 64] >> facet % 64 & 1U) != 0, to);
      order[i][1] = static_cast<std::uint32_t>(polygon.size());
      to += polygon.size();
    }
  });
  cells.facetPoints = std::move(facetPoints);
  cells.facetOffsets.resize(facets + 1);
  forEachPart([&](const FacetPart & part) {
    std::uint64_t end = part.firstPoint;
    for (std::size_t cell = part.firstCell; cell < part.lastCell; ++cell)
    {
      for (std::size_t i = start[cell]; i < start[cell + 1]; ++i)
      {
        end += order[i][1];
        cells.facetOffsets[i + 1] = end;
        order[i] = { static_cast<std::uint32_t>(cell), order[i][0] };
      }
    }
  });
  cells.facetCells = std::move(order);
}

} // namespace voxelcore
