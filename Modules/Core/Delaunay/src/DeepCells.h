#pragma once
// The cells that tracing left: those beyond the facets it could not cross.

#include "CellTracer.h"

namespace voxelcore
{

/** Completes a tracing of which some facets are left open, all of them listed in `deep`. Beyond them lies a union of
 *  Delaunay cells whose vertices are all on these facets: a vertex of such a cell is a corner of a boundary square on
 *  its side, and between that square (itself open if its cell is missing) and the missing cell the cells around the
 *  vertex change from known to unknown across an open facet. Which cells were traced does not matter.
 *  \throws Cancelled; CertificateError when the region does not close (a fault of this engine). */
Tracing
AddDeepCells(Tracing                           tracing,
             const std::vector<LatticePoint> & points,
             const SpacingWeights &            weights,
             const ProgressCallback &          progress);

} // namespace voxelcore
