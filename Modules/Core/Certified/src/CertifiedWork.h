#pragma once
// The order of the work on one request: whole core, certificate, fire, refinement, pruned cores, thickness; each part
// is freed when nothing needs it any more.

#include "SkeletonSteps.h"
#include "voxelcore/Certified/Certified.h"

namespace voxelcore
{

/** As ComputeCertified(), for a request that is complete and makes sense. A shape that `goesOn` beyond its scan's
 *  border has more voxels than the body that is asked about: its skeleton is cut in the border. */
CertifiedResult
RunCertified(VoxelShape                 shape,
             const ImageGeometry &      geometry,
             const CertifiedRequest &   request,
             const ProgressCallback &   progress,
             const BeyondBorder * const goesOn = nullptr);

} // namespace voxelcore
