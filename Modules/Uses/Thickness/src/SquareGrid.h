#pragma once
// The nearest boundary square of a voxel shape.

#include "NearSquares.h"
#include "PlaceGrid.h"

#include <vector>

namespace voxelcore
{

/** The squares between a voxel that is in and one that is out, by where they lie. The shape must outlive it. */
class SquareGrid
{
public:
  SquareGrid(const VoxelShape & shape, const SpacingWeights & weights);

  /** Distance of a place in lattice coordinates to the nearest square, in units of the weights' lattice; `within` when
   *  none is nearer. */
  double
  Distance(const Vector3 & place, double within) const;

  /** Whether no square is nearer than `within`; the place is in. */
  bool
  IsFree(const Vector3 & place, double within) const;

private:
  const VoxelShape &          m_Shape;
  Vector3                     m_Weights;
  std::vector<BoundarySquare> m_Squares; ///< in the order of their middles
  PlaceGrid                   m_Middles;
};

} // namespace voxelcore
