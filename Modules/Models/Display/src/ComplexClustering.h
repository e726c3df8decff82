#pragma once
// Vertices of a complex brought together in the cells of a grid, for showing.

#include "ShownMesh.h"

namespace voxelcore
{

/** Gives `mesh` in at most about `most` triangles and segments. `rims` are its edges with one triangle, each with the
 *  third corner of that triangle. */
ShownMesh
ClusteredMesh(const ShownMesh & mesh, const std::vector<std::array<std::uint32_t, 3>> & rims, std::size_t most);

} // namespace voxelcore
