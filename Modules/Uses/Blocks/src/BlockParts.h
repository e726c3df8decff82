#pragma once
// What the ways to plan and to compute blocks have in common.

#include "voxelcore/Blocks/HaloBlocks.h"

namespace voxelcore
{

/** \throws UsageError when the plan has no such block */
void
RequireBlock(const BlockPlan & plan, std::size_t block);

/** \throws InputError when numbers of a box of this size would leave the exact range */
void
RequireExactRange(const std::array<std::int32_t, 3> & size, const SpacingWeights & weights);

/** A block's share from what its balls can reach of the shape, `subshape`; `shape` shows all voxels around the block's
 *  corners. */
BlockShare
ShareOf(const VoxelShape &       shape,
        const VoxelShape &       subshape,
        const SpacingWeights &   weights,
        const BlockPlan &        plan,
        std::size_t              block,
        Engine                   engine,
        const ProgressCallback & progress);

} // namespace voxelcore
