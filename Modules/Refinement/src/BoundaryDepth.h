#pragma once
// How far cubes of voxels are from a boundary.

#include "BrickGrid.h"

#include "voxelcore/ImageGeometry.h"

namespace voxelcore
{

/** How far cubes of 2^3 voxels are from a boundary, farther off than a band field reaches. */
class BoundaryDepth
{
public:
  /** `sides` as for BandField, at most 2; what is within `reach` units of the boundary has a depth, but for what no
   *  ball of `radius` in the shape is near: there depths are 0. */
  BoundaryDepth(const VoxelShape &            shape,
                std::span<const LatticePoint> points,
                const Vector3 &               sides,
                double                        reach,
                double                        radius);

  const BrickGrid &
  Grid() const
  {
    return m_Grid;
  }
  const Vector3 &
  Squares() const
  {
    return m_Squares;
  }
  /** Of the distances of the voxels of a cell. */
  struct Depth
  {
    float mean = 0;    ///< positive inside
    float inside = 0;  ///< the greatest of voxels that are in, 0 when there are none
    float outside = 0; ///< the same of the others
  };
  const std::vector<Depth> &
  Depths() const
  {
    return m_Depths;
  }
  /** Leaves the grid alone. */
  void
  DropDepths()
  {
    std::vector<Depth>().swap(m_Depths);
  }

private:
  BrickGrid          m_Grid;
  Vector3            m_Squares; ///< of the sides of a cell
  std::vector<Depth> m_Depths;
};

} // namespace voxelcore
