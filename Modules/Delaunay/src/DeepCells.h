#pragma once
// The cells that tracing left: those beyond the facets it could not cross.

#include "BowyerWatson.h"
#include "CellTracer.h"


namespace voxelcore
{

/** Completes a tracing of which some facets are left open, all of them listed in `deep`. Beyond them lies a union of
 *  Delaunay cells whose vertices are all on these facets: a vertex of such a cell is a corner of a boundary square on
 *  its side, and between that square (itself open if its cell is missing) and the missing cell the cells around the
 *  vertex change from known to unknown across an open facet. The missing cells' spheres are empty, so the cells are
 *  among those of these points alone. Which cells were traced does not matter. While BowyerWatson() calls `meanwhile`
 *  the tracing stays as it is.
 *  \throws Cancelled; CertificateError when the region does not close (a fault of this engine). */
void
AddDeepCells(Tracing &                         tracing,
             const VoxelShape &                shape,
             const std::vector<LatticePoint> & points,
             const SpacingWeights &            weights,
             const Meanwhile &                 meanwhile,
             const ProgressCallback &          progress);

} // namespace voxelcore
