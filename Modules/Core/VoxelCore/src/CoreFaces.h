#pragma once
// The faces of a voxel core: one per Delaunay edge inside the shape, its sides dual to the facets around that edge.

#include "FacetPolygons.h"

#include "voxelcore/VoxelCore/VoxelCore.h"

namespace voxelcore
{

/** Writes the core's faces in canonical order, with their measures. Polygon i is that of the facet dual to edge i of
 *  the core, whose cells core.cells.edges already holds; polygons and points are as MeasureCells() leaves them.
 *  \throws CertificateError when the facets around an edge do not close. */
void
WriteFaces(FacetPolygons             polygons,
           std::vector<LatticePoint> sortedPoints,
           const SpacingWeights &    weights,
           CoreUse                   use,
           MedialComplex &           core);

} // namespace voxelcore
