#pragma once
// Which way the boundary of a shape faces, and how far a tolerance may reach there: what LargestWeighedGap() says,
// straight from the definition.

#include "voxelcore/Lattice/SpacingWeights.h"
#include "voxelcore/Shape/VoxelShape.h"

#include <array>
#include <cstdint>
#include <vector>

namespace voxelcore::verification
{

class BoundaryNormals
{
public:
  BoundaryNormals(const VoxelShape & shape, const SpacingWeights & weights);

  /** The diagonal over the extent across the boundary at a lattice corner. Thread-safe. */
  double
  WeightAt(const LatticePoint & corner) const;

  /** No weight is greater, and none less than 1. */
  double
  Largest() const
  {
    return m_Largest;
  }

private:
  /** What counts a voxel along an axis, from the farthest behind the corner on. */
  struct Line
  {
    std::vector<std::int64_t> sum;        ///< of what the two voxels at the corner have of it
    std::vector<std::int64_t> difference; ///< of the one before the corner less the one behind it
  };

  const VoxelShape &          m_Shape;
  std::array<double, 3>       m_Sides; ///< of a voxel, lattice units
  std::array<Line, 3>         m_Lines;
  std::array<std::int32_t, 3> m_Runs{};
  double                      m_Diagonal;
  double                      m_Least; ///< extent
  double                      m_Largest;
};

} // namespace voxelcore::verification
