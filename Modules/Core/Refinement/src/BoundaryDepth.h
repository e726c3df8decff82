#pragma once
// How far cubes of voxels are from a boundary.

#include "DistanceTile.h"

#include "voxelcore/Lattice/ImageGeometry.h"

#include <functional>

namespace voxelcore
{

/** How far cubes of 2^3 voxels are from a boundary, farther off than a band field reaches. */
class BoundaryDepth
{
public:
  static constexpr std::int32_t kTile = 32; ///< voxels
  /** Squares of distances to the nearest voxel of a kind, of a cube of voxels; tile::kNone or more where none is within
   *  16 voxels along each axis. */
  using Distances = tile::Squared<kTile>;
  /** What else they are good for: use(tile, to the nearest that is in, to the nearest that is out), by several threads;
   *  `tile` in units of cubes. */
  using UseDistances = std::function<void(const BrickGrid::Brick &, const Distances &, const Distances &)>;

  /** `sides` as for BandField, at most 2. Two radii of balls in units, the lesser first, the greater less than 16: what
   *  is within that of the boundary has a depth, but for what no ball of the lesser in the shape is near. */
  BoundaryDepth(const VoxelShape &            shape,
                std::span<const LatticePoint> points,
                const Vector3 &               sides,
                const std::array<double, 2> & radii,
                const UseDistances &          use);

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
  /** Of a brick's cells the mean of the distances of their voxels, positive inside; null where there are no depths. */
  const float *
  Means(std::size_t brick) const
  {
    return m_Places[brick] == kNone ? nullptr : m_Means[m_Places[brick]].data();
  }
  /** Cells, by brick, with a voxel where a ball about touches the boundary. */
  struct Centres
  {
    std::vector<BrickGrid::Flags> inside;
    std::vector<BrickGrid::Flags> outside;
  };
  /** Of the first or the second radius. */
  const Centres &
  CentresOf(std::size_t radius) const
  {
    return m_Centres[radius];
  }
  /** Leaves the grid alone. */
  void
  DropDepths()
  {
    decltype(m_Means)().swap(m_Means);
    m_Centres = {};
  }

private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  BrickGrid                                         m_Grid;
  Vector3                                           m_Squares; ///< of the sides of a cell
  std::vector<std::uint32_t>                        m_Places;  ///< of bricks in m_Means, or kNone
  std::vector<std::array<float, BrickGrid::kCells>> m_Means;
  std::array<Centres, 2>                            m_Centres;
};

} // namespace voxelcore
