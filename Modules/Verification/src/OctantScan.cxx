#include "voxelcore/OctantScan.h"

#include <array>
#include <bit>
#include <cstddef>

namespace voxelcore
{
namespace
{

/** Bit x + 2y + 4z of an octant mask is the voxel on side x, y, z (0 lower, 1 upper) of the corner. Eight times what
 *  the corner adds to the Euler number, from the definition of an inner element. */
constexpr int
EightfoldEuler(unsigned mask)
{
  int sum = std::popcount(mask);
  for (unsigned axis = 0; axis < 3; ++axis)
  {
    const unsigned step = 1U << axis;
    unsigned       upperSide = 0; // voxels on the upper side of the plane across this axis
    for (unsigned v = 0; v < 8; ++v)
    {
      if ((v & step) != 0)
      {
        upperSide |= 1U << v;
        const unsigned pair = (1U << v) | (1U << (v ^ step));
        sum -= (mask & pair) == pair ? 2 : 0;
      }
    }
    const unsigned lowerSide = 0xFFU & ~upperSide;
    sum += (mask & upperSide) == upperSide ? 4 : 0; // the edge that leaves the corner upwards along the axis
    sum += (mask & lowerSide) == lowerSide ? 4 : 0;
  }
  return sum - (mask == 0xFFU ? 8 : 0);
}

constexpr std::array<int, 256>
MakeTable()
{
  std::array<int, 256> table{};
  for (unsigned mask = 0; mask < 256; ++mask)
  {
    table[mask] = EightfoldEuler(mask);
  }
  return table;
}

constexpr std::array<int, 256> kEightfoldEuler = MakeTable();
static_assert(kEightfoldEuler[0] == 0 && kEightfoldEuler[255] == 0 && kEightfoldEuler[1] == 1);

} // namespace

OctantScan
ScanOctants(const VoxelShape & shape)
{
  OctantScan        scan;
  const VoxelBox &  box = shape.Box();
  const std::size_t words = shape.WordsPerRow();
  std::int64_t      sum = 0;
  for (std::int32_t z = 0; z <= box.size[2]; ++z)
  {
    for (std::int32_t y = 0; y <= box.size[1]; ++y)
    {
      // The four rows of voxels around this row of corners, in the order of the mask bits 0, 2, 4, 6.
      std::array<ConstShapeRow, 4> rows{};
      for (std::size_t side = 0; side < 4; ++side)
      {
        const std::int32_t ry = y - 1 + static_cast<std::int32_t>(side & 1U);
        const std::int32_t rz = z - 1 + static_cast<std::int32_t>(side >> 1U);
        rows[side] = shape.RowAnywhere(ry, rz);
      }
      unsigned lower = 0; // the four voxels on the lower side along x, at bits 0, 2, 4, 6
      for (std::size_t word = 0; word <= words; ++word)
      {
        std::array<std::uint64_t, 4> bits{};
        for (std::size_t side = 0; side < 4; ++side)
        {
          bits[side] = word < words ? rows[side][word] : 0;
        }
        const bool allOut = (bits[0] | bits[1] | bits[2] | bits[3]) == 0 && lower == 0;
        const bool allIn = (bits[0] & bits[1] & bits[2] & bits[3]) == ~std::uint64_t{ 0 } && lower == 0x55U;
        if (allOut || allIn)
        {
          continue;
        }
        const auto start = static_cast<std::int64_t>(word) * 64;
        for (std::int64_t bit = 0; bit < 64 && start + bit <= box.size[0]; ++bit)
        {
          unsigned upper = 0;
          for (std::size_t side = 0; side < 4; ++side)
          {
            upper |= static_cast<unsigned>((bits[side] >> bit) & 1U) << (2 * side);
          }
          const unsigned mask = lower | (upper << 1U);
          if (mask != 0 && mask != 0xFFU)
          {
            sum += kEightfoldEuler[mask];
            scan.boundary.push_back(
              { box.lower[0] + static_cast<std::int32_t>(start + bit), box.lower[1] + y, box.lower[2] + z });
          }
          lower = upper;
        }
      }
    }
  }
  scan.euler = sum / 8;
  return scan;
}

} // namespace voxelcore
