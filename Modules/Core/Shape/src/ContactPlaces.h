#pragma once
// Lattice corners around which a mask is not well-composed: its voxels, or those missing, meet over an edge or a corner
// alone.

#include "voxelcore/Shape/VoxelShape.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace voxelcore
{

/** Whether the eight voxels around a corner, bit i + 2 j + 4 k, hang together over faces, and those missing, too. */
constexpr bool
IsWellComposed(unsigned block)
{
  const auto hangTogether = [](unsigned set) {
    unsigned piece = set & (~set + 1);
    for (unsigned before = 0; before != piece;)
    {
      before = piece;
      piece |= (piece & 0x55U) << 1U | (piece & 0xAAU) >> 1U | (piece & 0x33U) << 2U | (piece & 0xCCU) >> 2U |
               (piece & 0x0FU) << 4U | (piece & 0xF0U) >> 4U;
      piece &= set;
    }
    return piece == set;
  };
  return hangTogether(block) && hangTogether(~block & 0xFFU);
}

inline constexpr std::array<bool, 256> kWellComposed = [] {
  std::array<bool, 256> table{};
  for (unsigned block = 0; block < 256; ++block)
  {
    table[block] = IsWellComposed(block);
  }
  return table;
}();

/** The corners, counted from the lower corner of the shape's box, where it is not well-composed; in scan order. */
std::vector<std::array<std::int32_t, 3>>
FindContacts(const VoxelShape & shape);

} // namespace voxelcore
