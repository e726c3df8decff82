#pragma once
// Voxels given to balls: those of a core, or those inscribed in a smooth surface (SmoothBalls.h).
//
// Each voxel belongs to the largest ball that holds its centre. Where none does (the centre lies beyond the smooth
// surface, or in a bump that pruning took for noise) the ball of the nearest voxel that has one counts.

#include "voxelcore/Thickness/LocalThickness.h"
#include "voxelcore/VoxelCore/MedialComplex.h"

#include <array>
#include <cstdint>

namespace voxelcore
{

/** The balls of a core's vertices, in their order; positions in lattice coordinates. */
PaintingBalls
BallsOfCore(const MedialComplex & core);

/** Finds the values of a field by voxel. The shape must outlive it. */
class VoxelRanks
{
public:
  explicit VoxelRanks(const VoxelShape & shape);

  /** Of a voxel, in indices of the scan, that is in: where its value stands. */
  std::size_t
  At(std::int32_t x, std::int32_t y, std::int32_t z) const;

private:
  const VoxelShape *         m_Shape;
  std::vector<std::uint64_t> m_Before; ///< voxels before each word of each row
};

/** Gives each voxel that has none the owner of the nearest voxel that has one: layer by layer through faces, edges and
 *  corners, from the nearest of its neighbours, of equally near ones from the one with the greatest ball. Components
 *  without any stay as they are. */
void
SpreadOwners(const VoxelShape &     shape,
             const SpacingWeights & weights,
             const PaintingBalls &  balls,
             VoxelOwners &          owners);

/** Owners among the balls, painted and spread. The same for every number of threads. \throws Cancelled */
VoxelOwners
OwnersAmong(const PaintingBalls &    balls,
            const VoxelShape &       shape,
            const SpacingWeights &   weights,
            const ProgressCallback & progress = {});

/** The thickness the owners give, mm; in components without any, the diameter of each voxel's own inscribed ball. */
VoxelValues
ThicknessOfOwners(const VoxelShape &     shape,
                  const SpacingWeights & weights,
                  const PaintingBalls &  balls,
                  const VoxelOwners &    owners);

/** The value at a place in lattice coordinates: that of the voxel it lies in or, as places on the smooth surface may
 *  lie outside, of the nearest one within two voxels; 0 where there is none. */
float
ValueNear(const VoxelShape & shape, const VoxelRanks & ranks, const VoxelValues & map, const Vector3 & place);

} // namespace voxelcore
