#include "CellTracer.h"

#include <algorithm>

namespace voxelcore
{

Tracing
JoinTracings(std::vector<Tracing> parts)
{
  Tracing    joined;
  FacetTable table;
  for (Tracing & part : parts)
  {
    DelaunayCells & to = joined.cells;
    DelaunayCells & from = part.cells;
    const auto      cellShift = static_cast<std::uint32_t>(to.CellCount());
    const auto      facetShift = static_cast<std::uint32_t>(to.FacetCount());
    const auto      pointShift = static_cast<std::uint64_t>(to.facetPoints.size());
    to.tetrahedra.insert(to.tetrahedra.end(), from.tetrahedra.begin(), from.tetrahedra.end());
    for (const auto & sides : from.facetCells)
    {
      to.facetCells.push_back(
        { sides[0] < kOpen ? sides[0] + cellShift : sides[0], sides[1] < kOpen ? sides[1] + cellShift : sides[1] });
    }
    for (std::size_t i = 1; i < from.facetOffsets.size(); ++i)
    {
      to.facetOffsets.push_back(from.facetOffsets[i] + pointShift);
    }
    to.facetPoints.insert(to.facetPoints.end(), from.facetPoints.begin(), from.facetPoints.end());
    from = {};
    for (const auto * list : { &part.open, &part.deep, &part.unmet })
    {
      const std::uint32_t kind = list == &part.deep ? 1U : 0U;
      for (const std::uint32_t facet : *list)
      {
        const std::uint32_t own = facet + facetShift;
        const FacetKey      key = KeyOf(to.FacetPoints(own));
        const std::uint32_t met = table.Take(key);
        if (met == FacetTable::none)
        {
          table.Insert(key, own);
          if (kind == 1U)
          {
            joined.deep.push_back(own);
          }
          continue;
        }
        // The two halves become one; the other is left without a cell, to be dropped with its like at the end.
        auto &              a = to.facetCells[met];
        auto &              b = to.facetCells[own];
        const std::uint32_t cell = b[0] < kOpen ? b[0] : b[1];
        if (a[0] == kOpen)
        {
          a[0] = cell < kOpen ? cell : kOpen;
        }
        else if (a[1] == kOpen)
        {
          a[1] = cell;
        }
        b = { kOpen, kOpen };
      }
    }
  }
  std::vector<std::uint8_t> isDeep(joined.cells.FacetCount(), 0);
  for (const std::uint32_t facet : joined.deep)
  {
    isDeep[facet] = 1;
  }
  table.ForEach([&](std::uint32_t facet) {
    const auto & sides = joined.cells.facetCells[facet];
    if (!isDeep[facet] && (sides[0] == kOpen || sides[1] == kOpen))
    {
      joined.open.push_back(facet);
    }
    else if (!isDeep[facet])
    {
      joined.unmet.push_back(facet);
    }
  });
  std::erase_if(joined.deep, [&](std::uint32_t facet) {
    const auto & sides = joined.cells.facetCells[facet];
    return sides[0] != kOpen && sides[1] != kOpen;
  });
  return joined;
}

} // namespace voxelcore
