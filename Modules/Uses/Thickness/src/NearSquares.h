#pragma once
// The boundary squares that stick into a ball which holds no boundary vertex.
//
// Let R be the radius of an open ball about c without a boundary vertex, and Q a square nearer to c than R. The nearest
// place of Q is no corner. If it is within Q, then Q lies across the line through c along Q's normal, and as the
// corners are not in the ball, no nearer than the root of R^2 - s^2, s being the distance of that line to the nearest
// of the lattice's corners. If it is on an edge of Q, then c lies between the ends of that edge along it, which as the
// nearer end is not in the ball leaves an annulus of lattice corners across the edge: from the root of R^2 - m^2 to R,
// m being the distance from c to that end along the edge. This annulus has an area of at most a square's, so that of
// each direction there is about one edge to look at, wherever the boundary is.

#include "voxelcore/Lattice/ImageGeometry.h"
#include "voxelcore/Lattice/SpacingWeights.h"
#include "voxelcore/Shape/VoxelShape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace voxelcore
{

/** Twice the lattice coordinates of a square's middle; the axis it is normal to has the even coordinate of the lattice,
 *  the others odd ones. */
using BoundarySquare = std::array<std::int32_t, 3>;

/** Of a voxel, in units of the weights' lattice. */
inline Vector3
WeightsOf(const SpacingWeights & weights)
{
  return { static_cast<double>(weights.weight[0]),
           static_cast<double>(weights.weight[1]),
           static_cast<double>(weights.weight[2]) };
}

/** The squared distance of a place in lattice coordinates to a square. */
inline double
SquaredDistance(const BoundarySquare & square, const Vector3 & place, const Vector3 & weights)
{
  double squared = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double half = (square[axis] & 1) != 0 ? 0.5 : 0.0;
    const double beyond = std::max(std::abs(place[axis] - 0.5 * square[axis]) - half, 0.0) * weights[axis];
    squared += beyond * beyond;
  }
  return squared;
}

/** The shape must outlive it. Thread-safe. */
class NearSquares
{
public:
  NearSquares(const VoxelShape & shape, const SpacingWeights & weights);

  /** Adds the squares nearer to a place in the shape than `within`, where no boundary vertex is nearer. */
  void
  Find(const Vector3 & place, double within, std::vector<BoundarySquare> & squares) const;

  /** Distance of a place to the nearest of some squares; `within` when none is nearer. */
  double
  DistanceTo(std::span<const BoundarySquare> squares, const Vector3 & place, double within) const;

private:
  using Voxel = std::array<std::int32_t, 3>;

  void
  FindAcross(std::size_t axis, const Vector3 & place, double squared, std::vector<BoundarySquare> & squares) const;
  void
  FindByEdges(std::size_t axis, const Vector3 & place, double squared, std::vector<BoundarySquare> & squares) const;
  void
  AddAtEdge(std::size_t axis, Voxel voxel, std::vector<BoundarySquare> & squares) const;
  bool
  Contains(const Voxel & voxel) const
  {
    return m_Shape.Contains(voxel[0], voxel[1], voxel[2]);
  }

  const VoxelShape & m_Shape;
  Vector3            m_Weights;
};

} // namespace voxelcore
