#pragma once
// Surfaces of labels, for looking at.

#include "voxelcore/Lattice/ImageGeometry.h"
#include "voxelcore/Models/DisplayContent.h"
#include "voxelcore/Shape/VoxelShape.h"

namespace voxelcore
{

/** The surface of a label as it is shown: the isosurface of its voxels, smoothed so that steps vanish (about a voxel).
 *  Not for measuring. Empty for an empty shape. */
LabelSurfaceMesh
LabelSurface(const VoxelShape & shape, const ImageGeometry & geometry);

} // namespace voxelcore
