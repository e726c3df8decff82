#pragma once
// The part of a shape that decides which cells have their centre in a block (HaloBlocks.h says why).

#include "NearestVertex.h"

#include "voxelcore/Blocks/HaloBlocks.h"

#include <optional>

namespace voxelcore
{

/** A shape that agrees with the given one in all voxels around the lattice points that a ball centred in the block can
 *  reach, less its components that do not meet the block. Empty when the block holds no voxel. */
VoxelShape
MakeHaloRegion(const VoxelShape &       shape,
               const SpacingWeights &   weights,
               const HaloBlock &        block,
               const ProgressCallback & progress);

/** The voxels, in indices of the scan, that MakeHaloRegion() looks at. No voxels when the block holds none.
 *  `nearest` is that of the shape. */
VoxelBox
HaloBox(const VoxelShape &       shape,
        const SpacingWeights &   weights,
        const NearestVertex &    nearest,
        const HaloBlock &        block,
        const ProgressCallback & progress);

/** The same of a shape that is known in a window alone, its box, of a scan. Nothing when balls may reach beyond the
 *  window: `needed` is then all that must be known, or has no size when no boundary is in sight. */
std::optional<VoxelShape>
MakeHaloRegionWithin(const VoxelShape &       shape,
                     const VoxelBox &         scan,
                     const SpacingWeights &   weights,
                     const HaloBlock &        block,
                     VoxelBox &               needed,
                     const ProgressCallback & progress);

} // namespace voxelcore
