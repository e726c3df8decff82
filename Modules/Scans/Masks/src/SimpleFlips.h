#pragma once
// Homotopic growth and shrinking: voxels change sides one at a time, only simple ones.

#include "voxelcore/Shape/PaddedShape.h"

#include "voxelcore/Base/Progress.h"
#include "voxelcore/Masks/TopologySimplification.h"

namespace voxelcore
{

/** The cost of a voxel of padded shapes. */
class PaddedCost
{
public:
  PaddedCost(const ChangeCost & cost, const VoxelBox & box)
    : m_Cost(cost)
    , m_Box(box)
  {}

  std::uint32_t
  operator()(const Voxel & at) const
  {
    constexpr std::int32_t room = PaddedShape::kRoom;
    return m_Cost(at[0] - room + m_Box.lower[0], at[1] - room + m_Box.lower[1], at[2] - room + m_Box.lower[2]);
  }

private:
  const ChangeCost & m_Cost;
  VoxelBox           m_Box;
};

/** Flips voxels of `open` in `shape`, always the costliest of those that are simple at that moment (of equal cost the
 *  one that was reached first), and takes them out of `open`, until none that is left is simple. \throws Cancelled */
void
FlipSimpleVoxels(PaddedShape & shape, PaddedShape & open, const PaddedCost & cost, const ProgressCallback & progress);

} // namespace voxelcore
