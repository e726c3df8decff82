#pragma once
// The thickness of the voxels as they are, for which no core is needed.

#include "voxelcore/Certified.h"

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

} // namespace voxelcore
