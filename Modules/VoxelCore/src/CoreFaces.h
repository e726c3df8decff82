#pragma once
// The faces of a voxel core: one per Delaunay edge inside the shape, its sides dual to the facets around that edge.

#include "voxelcore/DelaunayCells.h"
#include "voxelcore/MedialComplex.h"

namespace voxelcore
{

/** Writes the core's faces in canonical order, with their measures. `cells` holds the inner facets only, in canonical
 *  order: facet i is dual to edge i of the core (whose cells core.cells.edges already holds). Its points are as
 *  MeasureCells() leaves them; what it holds is given back on the way.
 *  \throws CertificateError when the facets around an edge do not close. */
void
WriteFaces(DelaunayCells             cells,
           std::vector<LatticePoint> sortedPoints,
           const SpacingWeights &    weights,
           MedialComplex &           core);

} // namespace voxelcore
