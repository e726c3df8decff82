#pragma once
// Plates so thin that the voxels of one have holes or fall apart, and their core is lines.
//
// Slices that are thicker than a plate hold strips of it, and what is left of their core looks like that of rods. But
// where the voxels around a place lie in one plane, and seen from aside leave no gap wider than a slice, they are taken
// for a plate, as thick as their volume by their area is. A rod leaves gaps on two of its sides; so do rods that cross.

#include "voxelcore/SpacingWeights.h"
#include "voxelcore/VoxelShape.h"

#include <array>

namespace voxelcore
{

/** The shape must outlive it. Thread-safe. */
class ThinPlates
{
public:
  ThinPlates(const VoxelShape & shape, const SpacingWeights & weights);

  /** The thickness, mm, of the plate around a place in lattice coordinates, where the core's ball has this radius in
   *  mm; 0 where there is none, or one so thick that its core is sheets. */
  double
  ThicknessAt(const Vector3 & place, double radius) const;

private:
  /** Calls visit(way) with the way in mm from a place to each voxel's centre within reach along each axis. */
  template <typename TVisit>
  void
  VisitVoxels(const Vector3 & place, double reach, TVisit visit) const;

  const VoxelShape & m_Shape;
  Vector3            m_Sides{}; ///< mm a lattice unit
  double             m_Longest = 0;
  double             m_Square = 0; ///< mm a side
};

} // namespace voxelcore
