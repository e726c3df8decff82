#pragma once
// Triangle meshes out of files, strictly: what is cut off, or not a number, is refused.

#include "voxelcore/Lattice/TriangleMesh.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace voxelcore
{

/** A mesh that was read. */
struct MeshFile
{
  TriangleMesh  mesh;
  std::string   format;           ///< "STL", "OBJ", "PLY", "OFF", "VTK", "VTP"
  std::uint64_t polygons = 0;     ///< faces with more than three corners; they became fans of triangles
  bool          mayBeCut = false; ///< nothing in the format says how long it is, and its end looks wrong
};

/** Whether a path ends like a mesh's: .stl .obj .ply .off .vtk .vtp */
bool
IsMeshPath(const std::filesystem::path & path);

/** Reads STL (text and binary), OBJ, PLY (text and binary of either byte order), OFF (text), VTK's polydata (.vtk,
 *  .vtp). Coordinates are read in full precision and taken for LPS mm. Colours, normals, textures, lines and single
 *  points are passed over.
 *  \throws InputError when it is missing, damaged, cut off, no mesh, or holds a coordinate that is no finite number */
MeshFile
ReadMesh(const std::filesystem::path & path);

} // namespace voxelcore
