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

/** The ball that stands out of a skeleton most, if one does so by more than `standOut` mm; of equals the first. The
 *  balls looked at are those around the middles of voxels, up to the nearest boundary vertex. The skeleton is given by
 *  places, in lattice coordinates, and by how far each reaches, mm.
 *
 *  A ball stands out when, seen from every place,
 *  - it goes beyond the place's reach by more than `standOut`, and
 *  - it is wider than a corner of 60 degrees in which that reach lies: balls there shrink by half of the way.
 *  In both, half a voxel's diagonal is granted, as middles of voxels lie beside the medial axis. The same for every
 *  number of threads. */
std::optional<BallOutside>
BallStandingOut(const VoxelShape &                     shape,
                const SpacingWeights &                 weights,
                std::span<const std::array<double, 3>> positions,
                std::span<const double>                reach,
                double                                 standOut);

} // namespace voxelcore
