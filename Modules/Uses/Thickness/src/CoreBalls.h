#pragma once
// Balls about the vertices of a whole voxel core through the boundary vertices nearest to them, and about places
// between them.

#include "voxelcore/Delaunay/DelaunayCells.h"
#include "voxelcore/Lattice/ImageGeometry.h"
#include "voxelcore/Lattice/SpacingWeights.h"

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace voxelcore
{

/** How much longer a radius is at the far end of a piece of an edge: of a voxel's shortest side. */
constexpr double kInscribedStep = 1.0 / 8;

/** What is known of the core. Lengths are in units of the weights' lattice. `points` and `cells` must outlive it. */
struct CoreBalls
{
  std::span<const LatticePoint> points;
  const DelaunayCells &         cells;
  Vector3                       weights; ///< the sides of a voxel
  double                        least;   ///< of them
  double                        unit;    ///< mm
  std::vector<double>           radius;  ///< R of each core vertex: to the boundary vertices nearest to it

  Vector3
  FromPoint(std::uint32_t point, const Vector3 & place) const
  {
    const LatticePoint & at = points[point];
    return { (place[0] - at.x) * weights[0], (place[1] - at.y) * weights[1], (place[2] - at.z) * weights[2] };
  }
  double
  ToPoint(std::uint32_t point, const Vector3 & place) const
  {
    const Vector3 d = FromPoint(point, place);
    return std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  }
};

CoreBalls
FindCoreBalls(std::span<const LatticePoint> points, const DelaunayCells & cells, const SpacingWeights & weights);

/** Into how many pieces an edge is cut along which a length changes by so much. */
int
PiecesOf(double change, double step);

/** The place a part of the way from one to another. */
Vector3
Between(const Vector3 & from, const Vector3 & to, double part);

} // namespace voxelcore
