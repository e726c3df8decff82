#pragma once
// Masks whose voxels hang together over edges and corners, too: the closed union of the voxels (object 26-connected,
// background 6-connected), and a voxel shape, which is open, with the topology of that union.
//
// Where the eight voxels around a lattice corner hang together over faces, and so do those that are missing, the mask
// is well-composed there (Latecki 1997): both rules say the same. A shape that is well-composed everywhere has one
// topology. So voxels are put in, or taken out, at the corners where the mask is not, and each of these changes leaves
// the closed union what it was, as the voxel is simple for 26-connected shapes in a 6-connected background (Bertrand
// and Malandain 1994). First come single fills, and pairs of them, that leave fewer such corners; what they leave is
// settled by a walk over such changes. Then each change is taken back that the open shape does not need.
//
// The result turns with the grid and is the same on any number of threads. Time: that of looking at the boundary once,
// a word of 64 voxels at a time, and of the places that are not well-composed.

#include "voxelcore/Base/Progress.h"
#include "voxelcore/Lattice/TopologyNumbers.h"
#include "voxelcore/Shape/VoxelShape.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace voxelcore
{

/** Which neighbours of a voxel hang together with it: those over faces, or those over edges and corners, too; or these
 *  where pieces would fall apart without them, and nowhere else, so that no loop and no cavity comes or goes. */
enum class Connectivity
{
  Six = 6,
  TwentySix = 26,
  Joined = 0
};

/** "6", "26", "joined" */
std::string_view
ConnectivityName(Connectivity connectivity);

/** None for other names. */
std::optional<Connectivity>
ConnectivityNamed(std::string_view name);

/** \throws UsageError for other names */
Connectivity
RequireConnectivity(std::string_view name);

/** A shape that hangs together over faces, made of a mask that hangs together over corners. */
struct ConnectedShape
{
  VoxelShape    shape; ///< in its tight box, which is that of the mask
  std::uint64_t voxelsAdded = 0;
  std::uint64_t voxelsRemoved = 0;
  /** Lattice corners, in coordinates of the scan, where no changes were found that leave the topology what it is; none
   *  when the shape has the topology of the closed mask. In scan order. */
  std::vector<std::array<std::int32_t, 3>> left;
};

/** The open shape with the topology of the closed union of a mask. \throws Cancelled */
ConnectedShape
ConnectOverCorners(const VoxelShape & shape, const ProgressCallback & progress = {});

} // namespace voxelcore
