#include "CellTracer.h"
#include "MarkedPoints.h"

#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/SpentMemory.h"

#include <algorithm>
#include <functional>
#include <iterator>

namespace voxelcore
{

namespace
{

// Gives back what has been copied while the rest is still to come.
template <typename T, typename TChange>
void
AppendSpent(std::vector<T> from, std::vector<T> & to, TChange change)
{
  constexpr std::size_t step = std::size_t{ 1 } << 20; // elements
  SpentFront            spent(from);
  for (std::size_t first = 0; first < from.size(); first += step)
  {
    const std::size_t last = std::min(first + step, from.size());
    std::transform(from.begin() + static_cast<std::ptrdiff_t>(first),
                   from.begin() + static_cast<std::ptrdiff_t>(last),
                   std::back_inserter(to),
                   change);
    spent.SpendTo(last);
  }
}

// The points of facets of two tracings at least: one that closes another has no other points.
MarkedPoints
PointsOfSeveral(const std::vector<Tracing> & parts, std::size_t points)
{
  MarkedPoints before(points);
  MarkedPoints several(points);
  for (const Tracing & part : parts)
  {
    const auto visit = [&](auto visitPolygon) {
      for (const auto * list : { &part.open, &part.deep, &part.unmet })
      {
        for (const std::uint32_t facet : *list)
        {
          visitPolygon(part.cells.FacetPoints(facet));
        }
      }
    };
    visit([&](std::span<const std::uint32_t> polygon) {
      for (const std::uint32_t point : polygon)
      {
        if (before.IsMarked(point))
        {
          several.Mark({ &point, 1 });
        }
      }
    });
    visit([&](std::span<const std::uint32_t> polygon) { before.Mark(polygon); });
  }
  return several;
}

} // namespace

Tracing
JoinTracings(std::vector<Tracing> parts, std::size_t points)
{
  const MarkedPoints several = PointsOfSeveral(parts, points);
  Tracing            joined;
  FacetTable         table;
  for (Tracing & part : parts)
  {
    DelaunayCells &   to = joined.cells;
    DelaunayCells &   from = part.cells;
    const auto        cellShift = static_cast<std::uint32_t>(to.CellCount());
    const auto        facetShift = static_cast<std::uint32_t>(to.FacetCount());
    const std::size_t cells = from.CellCount();
    const auto        pointShift = static_cast<std::uint64_t>(to.facetPoints.size());
    if (cellShift == 0 && facetShift == 0)
    {
      to = std::move(from);
    }
    else
    {
      RunBoth(
        true,
        [&] {
          AppendSpent(std::move(from.tetrahedra), to.tetrahedra, std::identity());
          AppendSpent(std::move(from.facetPoints), to.facetPoints, std::identity());
          // Deep cells have no side on the boundary but walls.
          if (!to.voxelSides.empty() || !from.voxelSides.empty())
          {
            to.voxelSides.resize(cellShift, 0);
            from.voxelSides.resize(cells, 0);
            AppendSpent(std::move(from.voxelSides), to.voxelSides, std::identity());
          }
        },
        [&] {
          AppendSpent(std::move(from.facetCells), to.facetCells, [&](const std::array<std::uint32_t, 2> & sides) {
            return std::array{ sides[0] < kOpen ? sides[0] + cellShift : sides[0],
                               sides[1] < kOpen ? sides[1] + cellShift : sides[1] };
          });
          to.facetOffsets.pop_back();
          AppendSpent(std::move(from.facetOffsets), to.facetOffsets, [&](std::uint64_t offset) {
            return offset + pointShift;
          });
        });
    }
    from = {};
    const auto join = [&](const std::vector<std::uint32_t> & facets, std::vector<std::uint32_t> & joinedFacets) {
      for (const std::uint32_t facet : facets)
      {
        const std::uint32_t own = facet + facetShift;
        const auto          polygon = to.FacetPoints(own);
        if (!ranges::all_of(polygon, [&](std::uint32_t point) { return several.IsMarked(point); }))
        {
          joinedFacets.push_back(own);
          continue;
        }
        const FacetKey      key = KeyOf(polygon);
        const std::uint32_t met = table.Take(key);
        if (met == FacetTable::none)
        {
          table.Insert(key, own);
          joinedFacets.push_back(own);
          continue;
        }
        // The two halves become one; the other is left without a cell. A boundary square may have met the half that
        // knows its cell, or the one that does not.
        auto &              kept = to.facetCells[met];
        auto &              other = to.facetCells[own];
        const std::uint32_t cell = other[0];
        if (kept[0] == kOpen)
        {
          kept[0] = cell;
        }
        else if (kept[1] == kOpen)
        {
          kept[1] = cell;
        }
        other = { kOutside, kOutside };
      }
    };
    join(part.open, joined.open);
    join(part.deep, joined.deep);
    join(part.unmet, joined.unmet);
  }
  const auto isComplete = [&](std::uint32_t facet) {
    const auto & sides = joined.cells.facetCells[facet];
    return sides[0] != kOpen && sides[1] != kOpen;
  };
  std::erase_if(joined.open, isComplete);
  std::erase_if(joined.deep, isComplete);
  return joined;
}

} // namespace voxelcore
