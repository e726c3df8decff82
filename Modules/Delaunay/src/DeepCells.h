#pragma once
// The cells that tracing left: those beyond the facets it could not cross.

#include "CellTracer.h"

namespace voxelcore
{

/** Completes a tracing of which only deep facets are left open. The region beyond them is a union of Delaunay cells
 *  whose vertices all lie on these facets: each cell's vertex has inner facets around it down to the boundary squares,
 *  and the first untraced one is open. Their spheres are empty, so the cells are among those of these points alone.
 *  \throws Cancelled; CertificateError when the region does not close (a fault of this engine). */
void
AddDeepCells(Tracing &                         tracing,
             const std::vector<LatticePoint> & points,
             const SpacingWeights &            weights,
             const ProgressCallback &          progress);

} // namespace voxelcore
