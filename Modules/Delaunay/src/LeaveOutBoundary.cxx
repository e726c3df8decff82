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
      if (last - first != 4)
      {
        throw CertificateError("a Delaunay facet on the boundary is no side of a voxel; please report this input");
      }
      const std::uint32_t axis = areAlike ? 0 : AxisOfSide(points[corners[first]], points[corners[first + 2]]);
      sides[one] |= static_cast<std::uint8_t>(1U << axis);
    }
    first = last;
  }
  CutShort(cells.facetCells, kept);
  CutShort(cells.facetOffsets, kept + 1);
  CutShort(cells.facetPoints, end);
}

} // namespace voxelcore
