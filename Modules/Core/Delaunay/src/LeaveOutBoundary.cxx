#include "VoxelSides.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Base/SpentMemory.h"

#include <atomic>

namespace voxelcore
{

void
NoteBoundary(const std::vector<LatticePoint> & points, const SpacingWeights & weights, DelaunayCells & cells)
{
  const bool areAlike = AreAlike(weights);
  cells.voxelSides.resize(cells.CellCount(), 0);
  RunInParts(cells.FacetCount() > 10000, cells.FacetCount(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t facet = begin; facet < end; ++facet)
    {
      auto & [one, other] = cells.facetCells[facet];
      if (other != kOutside || one == kOutside)
      {
        continue;
      }
      const auto square = cells.FacetPoints(facet);
      if (square.size() != 4)
      {
        throw CertificateError("a Delaunay facet on the boundary is no side of a voxel; please report this input");
      }
      // Where all sides are alike, points need not be fetched.
      const std::size_t  axis = areAlike ? 0 : AxisAcross(points[square[0]], points[square[2]]);
      const std::uint8_t side = VoxelSide(axis, weights);
      atomic_ref<std::uint8_t>(cells.voxelSides[one]).fetch_or(side, std::memory_order_relaxed);
      one = kOutside;
    }
  });
}

void
LeaveOutBoundary(const std::vector<LatticePoint> & points, const SpacingWeights & weights, DelaunayCells & cells)
{
  NoteBoundary(points, weights, cells);
  // Pointers: after a write the compiler would have to read where each vector begins again.
  const std::size_t              facets = cells.FacetCount();
  std::array<std::uint32_t, 2> * pairs = cells.facetCells.data();
  std::uint64_t *                offsets = cells.facetOffsets.data();
  std::uint32_t *                corners = cells.facetPoints.data();
  std::size_t                    kept = 0;
  std::uint64_t                  end = 0;
  std::uint64_t                  first = 0;
  for (std::size_t facet = 0; facet < facets; ++facet)
  {
    const std::uint64_t last = offsets[facet + 1];
    if (pairs[facet][1] != kOutside)
    {
      for (std::uint64_t from = first; from < last; ++from)
      {
        corners[end++] = corners[from];
      }
      pairs[kept] = pairs[facet];
      offsets[++kept] = end;
    }
    first = last;
  }
  CutShort(cells.facetCells, kept);
  CutShort(cells.facetOffsets, kept + 1);
  CutShort(cells.facetPoints, end);
}

} // namespace voxelcore
