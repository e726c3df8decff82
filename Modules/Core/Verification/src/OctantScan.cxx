#include "voxelcore/Verification/OctantScan.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/ParallelTasks.h"

#include <algorithm>
#include <array>
#include <atomic>
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

/** Adds the layers first to last - 1 of corners. */
void
ScanLayers(const VoxelShape & shape, std::int32_t first, std::int32_t last, OctantScan & scan)
{
  const VoxelBox &  box = shape.Box();
  const std::size_t words = shape.WordsPerRow();
  for (std::int32_t z = first; z < last; ++z)
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
      std::array<std::uint64_t, 4> before{}; // the voxel on the lower side of the word's first corner, at bit 0
      for (std::size_t word = 0; word <= words; ++word)
      {
        std::array<std::uint64_t, 4> upper{}; // of each corner the voxel on its upper side
        std::array<std::uint64_t, 4> lower{};
        std::uint64_t                any = 0;
        std::uint64_t                all = ~std::uint64_t{ 0 };
        for (std::size_t side = 0; side < 4; ++side)
        {
          upper[side] = word < words ? rows[side][word] : 0;
          lower[side] = upper[side] << 1U | before[side];
          before[side] = upper[side] >> 63U;
          any |= upper[side] | lower[side];
          all &= upper[side] & lower[side];
        }
        const auto start = static_cast<std::int32_t>(64 * word);
        for (std::uint64_t mixed = any & ~all; mixed != 0; mixed &= mixed - 1)
        {
          const int bit = std::countr_zero(mixed);
          unsigned  mask = 0;
          for (std::size_t side = 0; side < 4; ++side)
          {
            mask |= static_cast<unsigned>((lower[side] >> bit & 1U) | (upper[side] >> bit & 1U) << 1U) << (2 * side);
          }
          scan.euler += kEightfoldEuler[mask];
          scan.boundary.push_back({ box.lower[0] + start + bit, box.lower[1] + y, box.lower[2] + z });
        }
      }
    }
  }
}

} // namespace

OctantScan
ScanOctants(const VoxelShape & shape)
{
  constexpr std::int32_t   layers = 8; // that a thread takes at a time
  const std::int32_t       count = shape.Box().size[2] + 1;
  std::vector<OctantScan>  parts(static_cast<std::size_t>((count + layers - 1) / layers));
  std::atomic<std::size_t> seen = 0; // makers run their work in such parts, too: that none is lost is counted here
  RunEach(parts.size(), [&](std::size_t part) {
    const std::int32_t first = static_cast<std::int32_t>(part) * layers;
    ScanLayers(shape, first, std::min(first + layers, count), parts[part]);
    ++seen;
  });
  if (seen != parts.size())
  {
    throw CertificateError(
      "certificate failed: a part of the shape's boundary was not looked at; there is no result; "
      "this is a fault of VoxelCore, please report it with the scan");
  }
  OctantScan scan;
  for (const OctantScan & part : parts)
  {
    scan.euler += part.euler;
    scan.boundary.insert(scan.boundary.end(), part.boundary.begin(), part.boundary.end());
  }
  scan.euler /= 8;
  return scan;
}

} // namespace voxelcore
