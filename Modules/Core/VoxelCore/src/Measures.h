#pragma once
// Radius measures of the elements dual to Delaunay cells and facets (paper, section 4, step 3), and the facets in the
// form the core's faces are made from.

#include "FacetPolygons.h"

#include "voxelcore/Delaunay/DelaunayCells.h"

namespace voxelcore
{

/** Set in a facet's point when the side from it to the next point lies on the boundary of the shape. */
inline constexpr std::uint32_t kBoundarySide = 0x80000000U;

/** Radii in mm: the squared one, an exact rational, is rounded once, then turned into mm. */
struct MeasuredCells
{
  std::vector<double>       sphere;       ///< per cell: radius of its empty sphere
  std::vector<double>       cell;         ///< per cell: of the smallest ball enclosing its points
  std::vector<double>       facet;        ///< per facet inside: of the smallest ball enclosing its points
  FacetPolygons             polygons;     ///< of the facets inside
  std::vector<LatticePoint> sortedPoints; ///< those that polygons name
};

/** Measures cells and facets. On the way the facets on the boundary go, which leaves those that are dual to the core's
 *  edges; their points are renumbered to their lexicographic order by (x, y, z), in which the points come back, and
 *  sides on the boundary get the mark kBoundarySide: cells and facets are in the order of their centres' x, so that
 *  what is worked on together then lies together in memory. Of the cells centres, where there were none as well, and
 *  the cells of facets are left. Below 2^31 points.
 *  \throws CertificateError where a facet on the boundary is no side of a voxel */
MeasuredCells
MeasureCells(const VoxelShape &        shape,
             std::vector<LatticePoint> points,
             const SpacingWeights &    weights,
             DelaunayCells &           cells);

/** From a squared length in unit^2 to mm; monotone, and the same everywhere so that equal measures stay equal. */
double
ToMillimetres(double squared, const SpacingWeights & weights);

} // namespace voxelcore
