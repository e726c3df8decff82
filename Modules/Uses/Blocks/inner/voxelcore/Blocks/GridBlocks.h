#pragma once
// Blocks of a scan that nobody ever holds whole: the plan comes from its size alone, each block reads the voxels it
// needs, and the numbers of the whole are added up from those of the blocks.
//
// Why it is enough. A block's region is read through a window. A lattice point whose eight voxels are all known is a
// boundary vertex of the whole, or not; the distance to the nearest one found so bounds the distance to the nearest one
// there is. So the bounds r(B) of HaloBlocks.h found in a window hold, and if all voxels around the lattice points
// within them lie in the window, it shows all that the block needs. If not, a greater window is read.

#include "voxelcore/Blocks/HaloBlocks.h"

#include <cstdint>
#include <functional>

namespace voxelcore
{

/** Gives the voxels of the shape in a box of the scan: a shape in any box; voxels outside the one asked for are not
 *  looked at. */
using RegionReader = std::function<VoxelShape(const VoxelBox &)>;

/** Blocks of `side` lattice corners along each axis, x fastest; the last ones of each row may be smaller. What the
 *  plan does not know is kNotCounted.
 *  \throws UsageError when side is below 8, or there would be more than 2^20 blocks; InputError when the numbers would
 *  leave the exact range (as ComputeDelaunayCells) */
BlockPlan
PlanGrid(const VoxelBox & scan, const SpacingWeights & weights, std::int32_t side);

/** The share of a block of a plan that PlanGrid() made, from what it asks `read` for: the block and a margin, and what
 *  the balls can reach where that is farther. Shares of one plan join as those of PlanBlocks() do.
 *  \throws UsageError when there is no such block; what `read` and ComputeDelaunayCells throw. */
BlockShare
ComputeBlockShare(const RegionReader &     read,
                  const VoxelBox &         scan,
                  const SpacingWeights &   weights,
                  const BlockPlan &        plan,
                  std::size_t              block,
                  Engine                   engine = Engine::Auto,
                  const ProgressCallback & progress = {});

} // namespace voxelcore
