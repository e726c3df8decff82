#pragma once
// The skeleton of one mask in the voxels of another: clDice, and what ATM'22 counts of trees.

#include "voxelcore/Compare/MaskComparison.h"
#include "voxelcore/Lattice/ImageGeometry.h"
#include "voxelcore/Shape/VoxelShape.h"
#include "voxelcore/Skeleton/SkeletonGraph.h"

#include <array>
#include <cstdint>
#include <vector>

namespace voxelcore
{

/** A branch is detected from this share of its length on (ATM'22; Zhang et al. 2023). */
inline constexpr double kDetectedShare = 0.8;

/** Of a length: what falls short of a limit by no more reaches it. Sums of a million pieces are off by less. */
inline constexpr double kLengthRounding = 1e-9;

/** A skeleton of a mask, cut where its lines go from voxel to voxel; what lies in no voxel of its own mask (where edits
 *  filled it) counts for nothing. Lengths in mm, branch by branch. */
struct CentrelineOverlap
{
  std::uint64_t voxels = 0;       ///< that its branches and isolated points pass through
  std::uint64_t voxelsInside = 0; ///< of them, in the other mask
  double        length = 0;
  double        lengthInside = 0; ///< in the other mask
  std::int64_t  branches = 0;     ///< of some length
  std::int64_t  detected = 0;     ///< with kDetectedShare of it in the other mask

  /** Share of the voxels; NaN where there are none. */
  double
  VoxelShare() const;
  /** ATM'22's tree length detected, TD (also DLR): there a share of voxels, here of mm. NaN without length. */
  double
  LengthShare() const;
  /** ATM'22's branches detected, BD; NaN without branches. */
  double
  BranchShare() const;
};

/** The voxels of `own` that a skeleton passes through, in scan order, each once. A place on the border of voxels is in
 *  that of greater index. Positions in LPS mm of the geometry. */
std::vector<std::array<std::int32_t, 3>>
SkeletonVoxels(const SkeletonGraph & graph, const ImageGeometry & geometry, const VoxelShape & own);

CentrelineOverlap
MeasureCentreline(const SkeletonGraph & graph,
                  const ImageGeometry & geometry,
                  const VoxelShape &    own,
                  const VoxelShape &    other);

/** clDice (Shit et al., CVPR 2021): the harmonic mean of topology precision, the share of B's skeleton voxels in A, and
 *  topology sensitivity, that of A's in B. 0 where both are; NaN where one has no skeleton. */
double
ClDice(const CentrelineOverlap & ofA, const CentrelineOverlap & ofB);

/** The independent loops of a skeleton whose lines leave the other mask, as `change`. Each is a branch off the tree of
 *  the shortest branches, and the way along that tree between its ends. */
std::vector<DifferingPart>
FindLeavingLoops(const SkeletonGraph & graph,
                 const ImageGeometry & geometry,
                 const VoxelShape &    other,
                 PartChange            change);

} // namespace voxelcore
