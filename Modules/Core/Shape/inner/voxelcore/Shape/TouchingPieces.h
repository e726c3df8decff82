#pragma once
// Pieces of a shape that touch over edges and corners alone, joined by as few voxels as that takes.

#include "voxelcore/Shape/VoxelShape.h"

#include <array>
#include <cstdint>
#include <vector>

namespace voxelcore
{

/** A shape of which pieces that touched over edges and corners share faces. */
struct JoinedPieces
{
  /** One voxel or two that make pieces one. */
  struct Joint
  {
    std::int64_t                             pieces = 0;
    std::vector<std::array<std::int32_t, 3>> voxels; ///< in coordinates of the scan
  };

  VoxelShape         shape;  ///< in its tight box, which is that of the mask
  std::vector<Joint> joints; ///< as they were made

  std::uint64_t piecesApart = 0; ///< that touch still, where it is too crowded or they were asked to

  /** By how many 6-connected pieces there are fewer. */
  std::uint64_t
  PiecesJoined() const
  {
    std::uint64_t fewer = 0;
    for (const Joint & joint : joints)
    {
      fewer += static_cast<std::uint64_t>(joint.pieces - 1);
    }
    return fewer;
  }

  std::uint64_t
  VoxelsAdded() const
  {
    std::uint64_t added = 0;
    for (const Joint & joint : joints)
    {
      added += joint.voxels.size();
    }
    return added;
  }
};

/** Joins 6-connected pieces that touch over edges and corners, by one voxel or two each, until none can be joined so or
 *  `least` are left. Each voxel put in joins pieces that are apart, or prepares that, and changes nothing else: neither
 *  a loop nor a cavity comes or goes, what does not touch stays apart, and what hangs together stays as it is. The
 *  result turns with the grid. */
JoinedPieces
JoinTouchingPieces(const VoxelShape & shape, std::int64_t least = 1);

} // namespace voxelcore
