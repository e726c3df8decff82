#pragma once
// Local thickness from a finished core: what a continuum would have, where the core is refined.
//
// The balls of a refined core, pruned of the staircase, touch the smooth surface that the voxels stand for. At each
// voxel the thickness is the diameter of the largest of them that holds its centre. Where none does (the centre lies
// beyond the smooth surface, or in a bump that pruning took for noise) the ball of the nearest voxel that has one
// counts, so that no spur has a say.

#include "voxelcore/LocalThickness.h"
#include "voxelcore/MedialComplex.h"

#include <array>
#include <cstdint>

namespace voxelcore
{

/** The balls of a core's vertices, in their order; positions in lattice coordinates. */
PaintingBalls
BallsOfCore(const MedialComplex & core);

/** The same with radii that are averaged with those of the vertices around, so many times: the greatest of many radii
 *  that err this way and that would be too great. Radii do not mix along an edge on which
 *  they change by `slope` of its length or more: that is no error but the body's. An end of a line keeps its own. The
 *  core's positions are in mm along any axes. */
PaintingBalls
EvenedBallsOfCore(const MedialComplex & core, int rounds, double slope);

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
