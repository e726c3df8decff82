#pragma once
// How far the balls of a block's voxels can reach out of it.

#include "NearestVertex.h"
#include "voxelcore/Base/Progress.h"
#include "voxelcore/Lattice/SpacingWeights.h"
#include "voxelcore/Shape/VoxelShape.h"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace voxelcore
{

/** Voxels, or corners of them, lower <= x < upper; relative to the shape's box. */
struct HaloRange
{
  std::array<std::int32_t, 3> lower{};
  std::array<std::int32_t, 3> upper{};
};

/** The greatest whole number whose square is not above `value`, for 0 <= value < 2^100. */
std::int64_t
FloorOfRoot(Int128 value);

/** Covers the voxels of a block by small boxes, each with a bound of how far a ball centred in it can reach. */
class HaloReaches
{
public:
  /** A small box of voxels with an upper bound of the distance from places in it to the nearest boundary vertex. */
  struct Reach
  {
    HaloRange box;
    Int128    fourSquared = 0;
  };

  /** `limits` are the voxels there are, known or not. All that is given must outlive this. */
  HaloReaches(const VoxelShape &     shape,
              const SpacingWeights & weights,
              const NearestVertex &  nearest,
              const HaloRange &      block,
              const HaloRange &      limits);

  bool
  BlockHoldsVoxels() const
  {
    return HoldsVoxels(m_Block);
  }

  /** \throws Cancelled */
  void
  Measure(const ProgressCallback & progress);

  const HaloRange &
  Block() const
  {
    return m_Block;
  }

  /** Voxels of the block and of all halos, once measured. */
  const HaloRange &
  Around() const
  {
    return m_Around;
  }

  /** Those that leave the block, once measured. */
  const std::vector<Reach> &
  All() const
  {
    return m_Reaches;
  }

  /** The voxels, along an axis, around lattice points that balls centred in the box can reach. */
  std::pair<std::int32_t, std::int32_t>
  Halo(const Reach & reach, std::size_t axis) const;

private:
  void
  Divide(const HaloRange & box, const NearestVertex::Answer & near, const ProgressCallback & progress);

  bool
  HoldsVoxels(const HaloRange & box) const;

  bool
  StaysInBlock(const Reach & reach) const;

  const VoxelShape &     m_Shape;
  const SpacingWeights & m_Weights;
  const NearestVertex &  m_Nearest;
  HaloRange              m_Block;
  HaloRange              m_Limits;
  HaloRange              m_Around;
  std::vector<Reach>     m_Reaches;
  std::size_t            m_Divided = 0;
};

} // namespace voxelcore
