#pragma once
// What an engine hands over: cells and facets in any numbering, to be put into canonical form.

#include "voxelcore/DelaunayCells.h"

namespace voxelcore
{

/** Numbers cells by exact centre, orders facets and polygons as DelaunayCells promises, and fills in the centres.
 *  Expects tetrahedra, facetCells (any order of the two; kOutside second), facetOffsets and facetPoints with every
 *  polygon counter-clockwise seen from outside facetCells[.][0].
 *  \throws CertificateError when two cells have the same centre (they were not merged). */
void
MakeCanonical(DelaunayCells & cells, const std::vector<LatticePoint> & points, const SpacingWeights & weights);

} // namespace voxelcore
