#pragma once
// Pruning by erosion thickness, to compare with.

#include "voxelcore/Lattice/SpacingWeights.h"
#include "voxelcore/VoxelCore/MedialComplex.h"

#include <vector>

namespace voxelcore::evaluation
{

/** The core without the simple pairs whose erosion thickness, burn time minus radius, lies below each threshold (mm,
 *  increasing). Only cells, positions and radii are filled in. */
std::vector<MedialComplex>
PruneByErosionThickness(const MedialComplex &       core,
                        const SpacingWeights &      weights,
                        double                      voxel,
                        const std::vector<double> & thresholds);

} // namespace voxelcore::evaluation
