#pragma once
// Rough masks: single voxels that noise has flipped are flipped back. Both are the same for every number of threads,
// and, but for ties between neighbours, turn with the shape. Results lie in tight boxes.

#include "voxelcore/Base/Progress.h"
#include "voxelcore/Shape/VoxelShape.h"

#include <cstdint>

namespace voxelcore
{

struct SmoothedShape
{
  VoxelShape    shape;
  std::uint64_t voxelsAdded = 0;
  std::uint64_t voxelsRemoved = 0;
  double        largestShift =
    0; ///< voxels: of any boundary vertex, before or after, from the other boundary; at most sqrt(3)
};

/** Without the roughness of single voxels, and with the same topology.
 *
 *  A voxel at the boundary changes sides when what lies around it, weighed so that curved boundaries do not shrink,
 *  speaks clearly for the other side; the clearest first, each by itself, and only a simple one: so components, loops
 *  and cavities stay as they are, exactly. Clean curved boundaries have about one such voxel for 200 vertices.
 *  No voxel changes but at the boundary (it or one of its 26 neighbours is on the other side), each one that changes
 *  keeps a face neighbour of the kind it was, and what stands on nothing thicker than two voxels does not go: neither
 *  shape nor background reaches further than one voxel beyond what it was. Volume is kept as far as the noise has no
 *  side: to within 0.5 % on balls and rods; parts one or two voxels thick lose one to three percent.
 *  \throws Cancelled when the callback says so. */
SmoothedShape
SmoothShape(const VoxelShape & shape, const ProgressCallback & progress = {});

/** A shape after mending, and by how much each topology number fell. */
struct MendedShape
{
  VoxelShape    shape;
  std::uint64_t voxelsAdded = 0;
  std::uint64_t voxelsRemoved = 0;
  std::uint64_t piecesJoined = 0;   ///< b0
  std::uint64_t loopsClosed = 0;    ///< b1
  std::uint64_t cavitiesFilled = 0; ///< b2
};

/** With the topology that flips of single voxels have added taken away: background voxels that join components, close a
 *  tunnel, or are cavities are put in; voxels that bridge a bay of a thicker part are taken out. No number but the
 *  three that are counted changes, and none rises. A tunnel is closed, and a bridge removed, only when its two ends
 *  meet within ten voxels on another way. Take it for masks that are known to be noisy: true holes of one voxel go,
 *  too. \throws Cancelled when the callback says so. */
MendedShape
MendShape(const VoxelShape & shape, const ProgressCallback & progress = {});

} // namespace voxelcore
