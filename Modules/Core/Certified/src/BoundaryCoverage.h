#pragma once
// That a core pruned by tolerance still reaches the boundary, measured by other means than those that pruned it.

#include "voxelcore/Certified/CertifiedCore.h"
#include "voxelcore/Shape/VoxelShape.h"

namespace voxelcore
{

/** Notes the largest distance of a boundary vertex to the balls of `core`, which is pruned by tolerance, and the
 *  largest share of such a distance in what is promised there. Whether a distance was promised: of a core pruned by
 *  lambda first, none was.
 *  \throws CertificateError where the distance is beyond the promise */
bool
CertifyCoverage(CertifiedCore & core, const VoxelShape & voxels, const CertifiedShape & shape);

} // namespace voxelcore
