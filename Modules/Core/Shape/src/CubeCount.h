#pragma once
// In how many places a cube of voxels fits into a shape, layer by layer.

#include "BitPlane.h"

#include <cstdint>
#include <deque>

namespace voxelcore
{

class CubeCount
{
public:
  /** Cubes of `side` voxels; at least 9, at most 32. */
  CubeCount(unsigned side, std::size_t rows, std::size_t words);

  /** The next layer of the shape, along z. */
  void
  Add(const BitPlane & voxels);

  std::uint64_t
  Places() const
  {
    return m_Places;
  }

private:
  unsigned             m_Side;
  BitPlane             m_Along;  // of the layer: bits at which side voxels along x are in
  std::deque<BitPlane> m_Layers; // the last `side` layers: bits at which a square of them is in
  unsigned             m_Filled; // how many of the last layers have such a bit, without a gap
  std::uint64_t        m_Places = 0;
};

} // namespace voxelcore
