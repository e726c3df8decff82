#pragma once
// Voxels that a surface passes through.

#include "ExactTriangle.h"
#include "MeshSurface.h"
#include "voxelcore/Shape/VoxelShape.h"

#include <cstdint>

namespace voxelcore
{

/** Adds each voxel of the grid that a triangle comes within a billionth of a voxel of; returns how many were added. */
std::uint64_t
AddTouchedVoxels(const IndexMesh & mesh, const MeshSurface & surface, VoxelShape & shape);

} // namespace voxelcore
