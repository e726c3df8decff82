#pragma once
// What is wrong with a mask as networks and noise make them, and which options mend it.

#include "voxelcore/Base/Progress.h"
#include "voxelcore/Lattice/TopologyNumbers.h"
#include "voxelcore/Shape/VoxelShape.h"

#include <cstdint>
#include <string>

namespace voxelcore
{

/** What is found in a mask. Everything but `touching` is counted after the pieces that touch are joined. */
struct MaskDiagnosis
{
  std::uint64_t   voxels = 0;
  TopologyNumbers topology;           ///< of the voxel shape: 6-connected
  std::uint64_t   touching = 0;       ///< pieces that touch others over edges or corners: JoinTouchingPieces joins them
  std::uint64_t   touchingVoxels = 0; ///< those outside the largest piece that then are in it, without the fills
  std::uint64_t   torn = 0;           ///< pieces a voxel apart: MendShape joins them
  std::uint64_t   tornVoxels = 0;     ///< those outside the largest piece that then are in it, without the fills
  std::uint64_t   loops = 0;          ///< a voxel wide: it closes them
  std::uint64_t   bridges = 0;        ///< voxels that it takes out, each a bridge that makes such a loop
  std::uint64_t   cavities = 0;       ///< of one voxel: it fills them
  std::uint64_t   islands = 0;        ///< pieces then left that have less than a hundredth of the largest one's voxels
  std::uint64_t   islandVoxels = 0;
  std::uint64_t   largestIsland = 0; ///< its voxels
  std::uint64_t   leastPiece = 0;    ///< voxels of the smallest piece that is no island

  std::uint64_t
  Sum() const
  {
    return torn + loops + cavities + islands;
  }

  /** Whether noise decides much: a tenth or more of all loops and cavities and of all pieces but one, so that nothing
   *  is said of a foam or a gyroid whose holes are wide; and one voxel in 400 or more, so that nothing is said of one
   *  fault in a big body. A piece or a loop decides the voxels around a hole that is a voxel wide, where the curve runs
   *  around it, or all of its own if these are more; a cavity decides its voxel, since curves fill it. */
  bool
  IsNoisy() const;

  /** Whether noise makes most loops of a body that is one piece but for islands: so it may be a tree. */
  bool
  MayBeTree() const;

  /** "12 islands of at most 27 voxels (0.34 % of the voxels), 1 loop and 11 cavities a voxel wide" */
  std::string
  NoiseText() const;

  /** What mends that and removes nothing else: "--mend-shape --min-voxels 28" */
  std::string
  NoiseOptions() const;

  /** Voxels that these options take out. */
  std::uint64_t
  VoxelsRemoved() const
  {
    return bridges + islandVoxels;
  }
};

/** Looks at a mask. Takes as long as MendShape() where it has a loop, a cavity or a second piece, else no more than
 *  counting these. \throws Cancelled */
MaskDiagnosis
DiagnoseMask(const VoxelShape & shape, const ProgressCallback & progress = {});

/** Looks at its pieces alone, which takes no time where none touch over edges or corners. */
MaskDiagnosis
DiagnoseTouching(const VoxelShape & shape);

/** "0.34 %" of a part of all, of no more than two digits that count. */
std::string
ShareText(std::uint64_t part, std::uint64_t all);

} // namespace voxelcore
