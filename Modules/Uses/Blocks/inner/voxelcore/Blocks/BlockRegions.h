#pragma once
// Blocks computed from the voxels around them alone: what a plan knows beforehand of where these lie, so that of a
// large scan nothing else need be read, and a file that keeps it.
//
// Why it is enough. Let Around be the block and all that HaloBlocks.h calls B with its r(B). Every lattice point within
// r(B) of B has its eight voxels in Around, so a shape cut off there has the same boundary vertices within r(B); those
// that the cut adds are farther away. The bounds found again from the cut shape are therefore no smaller than needed.

#include "voxelcore/Blocks/HaloBlocks.h"

#include <array>
#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

namespace voxelcore
{

/** The part of a shape that one block needs. */
struct BlockRegion
{
  VoxelBox                     box; ///< voxel indices of the scan, within the shape's box; no voxels: nothing is needed
  std::uint64_t                voxels = 0; ///< of the shape in it
  std::array<std::uint64_t, 2> digest{};   ///< of these

  friend bool
  operator==(const BlockRegion & a, const BlockRegion & b)
  {
    return a.box.lower == b.box.lower && a.box.size == b.box.size && a.voxels == b.voxels && a.digest == b.digest;
  }
};

/** The region of each block. Takes the time of finding all halos; no cell is computed. \throws Cancelled */
std::vector<BlockRegion>
FindBlockRegions(const VoxelShape &       shape,
                 const SpacingWeights &   weights,
                 const BlockPlan &        plan,
                 const ProgressCallback & progress = {});

/** Whether a shape has the voxels that the region's had in its box; what it has elsewhere is not looked at. */
bool
IsRegionOf(const BlockRegion & region, const VoxelShape & shape);

/** The points and cells of the share that ComputeBlockShare() gives for the whole shape, from `part`, its voxels in the
 *  region; shares of both kinds join. Order and triangulation of cells may differ, as between engines.
 *  \throws UsageError when there is no such block; InputError when `part` or the weights are others; what
 *  ComputeDelaunayCells throws. */
BlockShare
ComputeBlockShare(const VoxelShape &       part,
                  const SpacingWeights &   weights,
                  const BlockPlan &        plan,
                  const BlockRegion &      region,
                  std::size_t              block,
                  Engine                   engine = Engine::Auto,
                  const ProgressCallback & progress = {});

/** One label of a scan that has been cut. */
struct PlannedLabel
{
  std::int64_t             value = 0;
  std::string              name;
  BlockPlan                plan;
  std::vector<BlockRegion> regions; ///< one a block
};

struct ScanPlan
{
  std::string               source; ///< which scan, and how it was read: whoever uses the plan compares it
  std::vector<PlannedLabel> labels;
};

/** Writes a plan in its binary form: version, checksum, the same bytes on every machine.
 *  \throws OutputError when the stream fails. */
void
WriteScanPlan(const ScanPlan & plan, std::ostream & stream);

/** Reads what WriteScanPlan wrote. `name` says in errors what was read.
 *  \throws InputError when it is not a plan, of another version, cut off, or damaged. */
ScanPlan
ReadScanPlan(std::istream & stream, const std::string & name);

} // namespace voxelcore
