#pragma once
// A mesh made ready: points welded, triangles that say nothing left out, orientation repaired, and what it is judged to
// be.

#include "voxelcore/Meshes/Voxelization.h"

#include <array>
#include <cstdint>
#include <vector>

namespace voxelcore
{

struct MeshSurface
{
  std::vector<std::array<std::uint32_t, 3>> triangles;          ///< of the mesh's points; of equal points the first
  bool                                      isOriented = false; ///< neighbours agree in orientation everywhere
  int                                       sense = 1;          ///< winding number of most of the inside: 1, or -1
  MeshFindings                              findings;
};

/** \throws InputError for edges on three, five, ... triangles */
MeshSurface
PrepareSurface(const TriangleMesh & mesh);

} // namespace voxelcore
