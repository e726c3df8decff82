#pragma once
// Triangle mesh in, voxel shape out: Gauss digitization (paper, section 4.1). A voxel is in when its centre is in,
// decided exactly for closed meshes: coordinates are taken as the numbers they are, and a centre on the surface as if
// it were moved by (e, e^2, e^3) for an arbitrarily small e (simulation of simplicity), so no crossing is missed or
// counted twice.

#include "voxelcore/Base/Progress.h"
#include "voxelcore/Lattice/TriangleMesh.h"
#include "voxelcore/Shape/VoxelShape.h"

#include <array>
#include <cstdint>

namespace voxelcore
{

/** Where voxels lie. The centre of voxel (i,j,k) is origin + ((i,j,k) + 1/2) * spacing, taken exactly. */
struct VoxelGrid
{
  Vector3                     origin{ 0, 0, 0 };  ///< LPS mm, the corner where all coordinates are smallest
  Vector3                     spacing{ 1, 1, 1 }; ///< mm
  std::array<std::int32_t, 3> size{ 0, 0, 0 };
};

/** Cubic voxels, `resolution` of them (1 to 2^20) along the longest side of the bounding box, from its minimum corner.
 *  \throws InputError for a mesh without triangles or extent, or with a coordinate that is not finite or beyond 1e9
 *  mm */
VoxelGrid
GridOfResolution(const TriangleMesh & mesh, std::int64_t resolution);

/** Voxels of this size from the minimum corner of the bounding box.
 *  \throws InputError as GridOfResolution, and for more than 2^20 voxels on a side; UsageError unless it is positive */
VoxelGrid
GridOfSpacing(const TriangleMesh & mesh, const Vector3 & spacing);

/** Closes each loop of open edges (on an odd number of triangles) with triangles around the mean of its points, and
 *  says how many there were. */
std::uint64_t
CapHoles(TriangleMesh & mesh);

/** By what it is decided whether a centre is in. */
enum class InsideRule
{
  Winding, ///< the surface is closed and oriented: in where its winding number is not 0
  Parity,  ///< closed, but of no orientation: in where a ray crosses it an odd number of times
  Votes    ///< not closed, or more than two sheets meet: in where at least four of the six rays along the axes say so
};

/** What was found and set right in a mesh. */
struct MeshFindings
{
  std::uint64_t triangles = 0;  ///< as given
  std::uint64_t pieces = 0;     ///< triangles that hang together over edges
  std::uint64_t degenerate = 0; ///< with a corner twice: left out
  std::uint64_t duplicates = 0; ///< left out because others have the same corners
  std::uint64_t flipped = 0;    ///< turned to agree with their neighbours
  std::uint64_t openEdges = 0;  ///< on an odd number of triangles: one at a hole, three where sheets meet
  InsideRule    rule = InsideRule::Winding;
};

struct Voxelization
{
  VoxelShape    shape; ///< in its tight box; indices are those of the grid
  MeshFindings  findings;
  std::uint64_t voxels = 0;

  /** By rule Winding: voxels in several parts at once, or in one that is inside out while the mesh as a whole is not.
   *  By Votes: voxels, in or not, of which the rays do not all say the same. */
  std::uint64_t doubtful = 0;

  std::uint64_t touched = 0; ///< with `cover`: voxels that were added
};

/** With `cover` each voxel that the surface passes through (by a billionth of a voxel or more, or less) is in, too:
 *  parts thinner than a voxel stay, and what hangs together in the mesh hangs together over faces, edges or corners of
 *  voxels.
 *
 *  Time and memory grow with the surface, besides one bit a voxel of the grid (nine bits for a rule of Votes, of two
 *  slices only). The result does not depend on the number of threads.
 *  Progress is reported as stage "voxelize".
 *  \throws InputError, without the name of a file, for a mesh that bounds nothing (no voxel is in, or nowhere do five
 *  of six rays say in); Cancelled */
Voxelization
Voxelize(const TriangleMesh & mesh, const VoxelGrid & grid, const ProgressCallback & progress = {}, bool cover = false);

} // namespace voxelcore
