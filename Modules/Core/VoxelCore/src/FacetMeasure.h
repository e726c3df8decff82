#pragma once
// How large the smallest ball around a Delaunay facet is.

#include "voxelcore/Lattice/LatticePoint.h"
#include "voxelcore/Lattice/SpacingWeights.h"

#include <vector>

namespace voxelcore
{

/** Squared radius, in unit^2 and rounded once, of the smallest ball around a convex polygon of cospherical points. */
double
MeasureFacet(const std::vector<LatticePoint> & polygon, const SpacingWeights & weights);

} // namespace voxelcore
