#pragma once
// What makers and checkers share of the lattice, looked at before it is used: a fault in it would be one in both.

#include "voxelcore/Lattice/ImageGeometry.h"
#include "voxelcore/Lattice/SpacingWeights.h"
#include "voxelcore/Shape/VoxelShape.h"

#include <string>

namespace voxelcore
{

/** The weights must be the voxel's sides, but for kLargestDeviation, and PhysicalToLattice() must lead back from the
 *  corners of the shape's box, and so, as it is affine, from everywhere. \throws CertificateError */
void
RequireTrueLattice(const SpacingWeights & weights,
                   const ImageGeometry &  geometry,
                   const VoxelBox &       box,
                   const std::string &    name);

} // namespace voxelcore
