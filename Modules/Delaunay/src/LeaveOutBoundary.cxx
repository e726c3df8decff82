#include "voxelcore/DelaunayCells.h"

#include "voxelcore/Error.h"
#include "voxelcore/SpentMemory.h"

namespace voxelcore
{

namespace
{

std::uint32_t
AxisOfSide(const LatticePoint & corner, const LatticePoint & opposite)
{
  return corner.x == opposite.x ? 0 : corner.y == opposite.y ? 1 : 2;
}

} // namespace

void
LeaveOutBoundary(const std::vector<LatticePoint> & points, const SpacingWeights & weights, DelaunayCells & cells)
{
  // Where all sides are alike, points need not be fetched.
  const bool areAlike = weights.weight[0] == weights.weight[1] && weights.weight[1] == weights.weight[2];
  cells.voxelSides.assign(cells.CellCount(), 0);
  std::size_t   kept = 0;
  std::uint64_t end = 0;
  for (std::size_t facet = 0; facet < cells.FacetCount(); ++facet)
  {
    const std::uint64_t first = cells.facetOffsets[facet];
    const std::uint64_t last = cells.facetOffsets[facet + 1];
    const auto [one, other] = cells.facetCells[facet];
    if (other != kOutside)
    {
      for (std::uint64_t from = first; from < last; ++from)
      {
        cells.facetPoints[end++] = cells.facetPoints[from];
      }
      cells.facetCells[kept] = { one, other };
      cells.facetOffsets[++kept] = end;
    }
    else if (one != kOutside)
    {
      if (last - first != 4)
      {
        throw CertificateError("a Delaunay facet on the boundary is no side of a voxel; please report this input");
      }
      const std::uint32_t axis =
        areAlike ? 0 : AxisOfSide(points[cells.facetPoints[first]], points[cells.facetPoints[first + 2]]);
      cells.voxelSides[one] |= static_cast<std::uint8_t>(1U << axis);
    }
  }
  CutShort(cells.facetCells, kept);
  CutShort(cells.facetOffsets, kept + 1);
  CutShort(cells.facetPoints, end);
}

} // namespace voxelcore
