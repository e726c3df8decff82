#pragma once
// The order of the work on one request: whole core, certificate, fire, refinement, pruned cores, thickness; each part
// is freed when nothing needs it any more.

#include "voxelcore/Certified.h"

namespace voxelcore
{

/** As ComputeCertified(), for a request that is complete and makes sense. */
CertifiedResult
RunCertified(VoxelShape               shape,
             const ImageGeometry &    geometry,
             const CertifiedRequest & request,
             const ProgressCallback & progress);

} // namespace voxelcore
