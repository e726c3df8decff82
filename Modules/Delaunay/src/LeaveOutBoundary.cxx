#include "VoxelSides.h"

#include "voxelcore/Error.h"
#include "voxelcore/ParallelTasks.h"
#include "voxelcore/SpentMemory.h"

#include <atomic>

namespace voxelcore
{

namespace
{

void
RequireSquare(std::size_t corners)
{
  if (corners != 4)
  {
    throw CertificateError("a Delaunay facet on the boundary is no side of a voxel; please report this input");
  }
}

} // namespace

void
LeaveOutBoundary(const std::vector<LatticePoint> & points, const SpacingWeights & weights, DelaunayCells & cells)
{
  const bool areAlike = AreAlike(weights);
  cells.voxelSides.assign(cells.CellCount(), 0);
  // Pointers: after a write the compiler would have to read where each vector begins again.
  const std::size_t              facets = cells.FacetCount();
  std::array<std::uint32_t, 2> * pairs = cells.facetCells.data();
  std::uint64_t *                offsets = cells.facetOffsets.data();
  std::uint32_t *                corners = cells.facetPoints.data();
  std::uint8_t *                 sides = cells.voxelSides.data();
  std::size_t                    kept = 0;
  std::uint64_t                  end = 0;
  std::uint64_t                  first = 0;
  for (std::size_t facet = 0; facet < facets; ++facet)
  {
    const std::uint64_t last = offsets[facet + 1];
    const auto [one, other] = pairs[facet];
    if (other != kOutside)
    {
      for (std::uint64_t from = first; from < last; ++from)
      {
        corners[end++] = corners[from];
      }
      pairs[kept] = { one, other };
      offsets[++kept] = end;
    }
    else if (one != kOutside)
    {
      RequireSquare(last - first);
      // Where all sides are alike, points need not be fetched.
      sides[one] |= areAlike ? std::uint8_t{ 1 }
                             : VoxelSide(AxisAcross(points[corners[first]], points[corners[first + 2]]), weights);
    }
    first = last;
  }
  CutShort(cells.facetCells, kept);
  CutShort(cells.facetOffsets, kept + 1);
  CutShort(cells.facetPoints, end);
}

void
NoteBoundary(const std::vector<LatticePoint> & points, const SpacingWeights & weights, DelaunayCells & cells)
{
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
      RequireSquare(square.size());
      const std::uint8_t side = VoxelSide(AxisAcross(points[square[0]], points[square[2]]), weights);
      std::atomic_ref<std::uint8_t>(cells.voxelSides[one]).fetch_or(side, std::memory_order_relaxed);
      one = kOutside;
    }
  });
}

} // namespace voxelcore
