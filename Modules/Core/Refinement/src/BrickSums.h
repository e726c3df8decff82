#pragma once
// Sums of a separable kernel over the values of bricks.

#include "BrickGrid.h"

#include <vector>

namespace voxelcore
{

/** Symmetric weights along an axis. */
struct Kernel
{
  static constexpr std::size_t kMostRadius = BrickGrid::kSide; ///< a brick's neighbours hold all it needs

  std::size_t                        radius = 0;
  std::array<float, kMostRadius + 1> weights{}; ///< by distance from the centre
};
using Kernels = std::array<Kernel, 3>;
using BrickValues = std::array<float, BrickGrid::kCells>;

/** Values of the bricks of three planes that follow each other along z. */
struct PlaneValues
{
  const float *                 values = nullptr;
  std::array<std::ptrdiff_t, 3> shift{}; ///< brick b of a plane is the one at b + shift in `values`
};

/** Sums along z, then y, then x, of one brick after the other along a row: what is summed along two axes is kept for
 *  the next brick. Where there is no brick all values, and sums, are those of `far`. */
class BrickSums
{
public:
  /** The row is in the middle plane. `far`: outside, inside. */
  BrickSums(const BrickGrid &                  grid,
            const Kernels &                    kernels,
            const PlaneValues &                values,
            const std::array<BrickValues, 2> & far)
    : m_Grid(grid)
    , m_Kernels(kernels)
    , m_Values(values)
    , m_Far(far)
  {}

  void
  Of(std::size_t brick, float * sums);

private:
  const float *
  Block(std::int32_t source, std::size_t plane) const
  {
    return source >= 0 ? m_Values.values + (source + m_Values.shift[plane]) * std::ptrdiff_t{ BrickGrid::kCells }
                       : m_Far[source == BrickGrid::kInside ? 1 : 0].data();
  }
  const float *
  AlongZAndY(std::int32_t brick);

  static constexpr std::int32_t kNoBrick = BrickGrid::kInside - 1;

  const BrickGrid &                  m_Grid;
  const Kernels &                    m_Kernels;
  const PlaneValues &                m_Values;
  const std::array<BrickValues, 2> & m_Far;
  std::array<BrickValues, 3>         m_Kept;
  std::array<std::int32_t, 3>        m_Bricks{ kNoBrick, kNoBrick, kNoBrick }; ///< whose sums are kept
  std::size_t                        m_Turn = 0;
};

} // namespace voxelcore
