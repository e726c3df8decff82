#pragma once
// The thickness of the voxels as they are, and of the smooth surface they stand for: no core is needed for either.

#include "voxelcore/Certified/Certified.h"

namespace voxelcore
{

/** The map of a shape, or of a part of its voxels, `part`, which has no bounds then. Nothing in it is of a core.
 *  \throws CertificateError when the cells do not end at the shape's boundary or a voxel has no thickness; what
 *  ComputeDelaunayCells throws */
CertifiedThickness
InscribedThickness(const VoxelShape &       voxels,
                   const VoxelShape *       part,
                   const ImageGeometry &    geometry,
                   const CertifiedRequest & request,
                   const ProgressCallback & progress);

/** Of the smooth surface that the labels stand for, or that the estimate tells, where there is one.
 *  \throws CertificateError when a ball reaches too far beyond the voxels, a voxel has no thickness, or by labels
 *  one outside the bounds; Cancelled */
CertifiedThickness
SmoothThickness(VoxelShape               voxels,
                const SpacingWeights &   weights,
                const SurfaceEstimate *  surface,
                bool                     bounds,
                const std::string &      name,
                const ProgressCallback & progress);

/** What SmoothThickness() needs of a request's source; none of labels. */
SurfaceSource::Estimate
SurfaceForThickness(const CertifiedRequest & request, const VoxelShape & voxels, const ProgressCallback & progress);

} // namespace voxelcore
