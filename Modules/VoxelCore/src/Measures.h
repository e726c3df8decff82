#pragma once
// Radius measures of the elements dual to Delaunay cells, facets and edges (paper, section 4, step 3).

#include "voxelcore/DelaunayCells.h"

namespace voxelcore
{

/** Squared radii in unit^2, each the exact rational rounded once. */
struct CellMeasures
{
  std::vector<double> sphere; ///< per cell: squared radius of its empty sphere
  std::vector<double> cell;   ///< per cell: of the smallest ball enclosing its points
  std::vector<double> facet;  ///< per facet: of the smallest ball enclosing its points
};

CellMeasures
MeasureCells(const DelaunayCells & cells, const std::vector<LatticePoint> & points, const SpacingWeights & weights);

/** From a squared length in unit^2 to mm; monotone, and the same everywhere so that equal measures stay equal. */
double
ToMillimetres(double squared, const SpacingWeights & weights);

} // namespace voxelcore
