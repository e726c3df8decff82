#pragma once
// Whether the branches of a skeleton leave out no part of its body: what --stand-out promises, looked at in the voxels
// with nothing of what chooses branches.

#include "voxelcore/Lattice/SpacingWeights.h"
#include "voxelcore/Shape/VoxelShape.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>

namespace voxelcore
{

/** A ball that no branch stands for. */
struct BallOutside
{
  double                      beyond = 0; ///< mm by which it reaches out of what the nearest place reaches
  std::array<std::int32_t, 3> voxel{};    ///< its centre
  double                      radius = 0; ///< mm
};

/** Of the balls around voxels, up to the nearest boundary vertex, the one that stands out of the places of a
 *  skeleton most, where one does so by more than `standOut` mm. Each place reaches so many mm around it. A ball stands
 *  out when it reaches farther beyond every place's reach and is wider than a corner of 60 degrees in which that reach
 *  lies: from there on balls become smaller by half of the way. In both, half a voxel's diagonal is granted, as middles
 *  of voxels lie beside the medial axis. Balls in groups of voxels are looked at once where none of them can stand out.
 *  Of equals the first; the same for every number of threads. Positions in lattice coordinates. */
std::optional<BallOutside>
BallStandingOut(const VoxelShape &                     shape,
                const SpacingWeights &                 weights,
                std::span<const std::array<double, 3>> positions,
                std::span<const double>                reach,
                double                                 standOut);

} // namespace voxelcore
