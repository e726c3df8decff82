#pragma once
// The nearest of many lattice points.

#include "voxelcore/Lattice/ImageGeometry.h"
#include "voxelcore/Lattice/LatticePoint.h"

#include <cstdint>
#include <span>
#include <vector>

namespace voxelcore
{

/** A k-d tree of lattice points without nodes of its own (Bentley 1975): the middle one of each part parts the rest, by
 *  x, then y, then z. Borrows the points. */
class PointTree
{
public:
  /** `spacing` in mm. */
  PointTree(std::span<const LatticePoint> points, const Vector3 & spacing);

  /** The square of how far the nearest one is from a place in mm along the lattice's axes; `within`^2 when none is
   *  nearer. */
  double
  SquaredDistance(const Vector3 & place, double within) const;

private:
  Vector3
  Place(std::uint32_t point) const;
  void
  Build(std::size_t first, std::size_t last, std::size_t axis);
  void
  Descend(std::size_t first, std::size_t last, std::size_t axis, const Vector3 & place, double & least) const;

  std::span<const LatticePoint> m_Points;
  Vector3                       m_Spacing;
  std::vector<std::uint32_t>    m_Order;
};

} // namespace voxelcore
