#pragma once
// The facets of one Delaunay cell: the convex hull of a few cospherical lattice points.

#include "voxelcore/Lattice/LatticePoint.h"

#include <cstdint>
#include <span>
#include <vector>

namespace voxelcore::verification
{

/** Each facet as a set of points: `stride` words of 64 bits, bit i for point i. */
struct CellFacets
{
  std::size_t                stride = 0;
  std::vector<std::uint64_t> masks;

  std::size_t
  Count() const
  {
    return stride == 0 ? 0 : masks.size() / stride;
  }
  std::span<const std::uint64_t>
  Mask(std::size_t facet) const
  {
    return { masks.data() + facet * stride, stride };
  }
};

/** Tries the plane through every three points: cells have few points. No three may be collinear (those on a sphere
 *  never are); the points span space. */
void
FindFacets(std::span<const LatticePoint> points, CellFacets & facets);

} // namespace voxelcore::verification
