#pragma once
// The voxel shape: the interior of a union of voxels, as packed bits (paper, section 3.2).

#include "voxelcore/Lattice/LatticePoint.h"
#include "voxelcore/Shape/BitBricks.h"

#include <array>
#include <cstdint>

namespace voxelcore
{

/** Voxels lower to lower + size - 1 along each axis, in voxel indices of the scan. */
struct VoxelBox
{
  std::array<std::int32_t, 3> lower{ 0, 0, 0 };
  std::array<std::int32_t, 3> size{ 0, 0, 0 };
};

/** One bit a voxel. Rows run along x in words of 64 voxels, least significant bit first; bits beyond the box are 0.
 *  Everything outside the box is background. Sides up to 2^30. Memory follows the boundary, not the box (BitBricks.h),
 *  once Compact() has looked at what was written. */
class VoxelShape
{
public:
  VoxelShape() = default;

  /** All background. */
  explicit VoxelShape(const VoxelBox & box);

  const VoxelBox &
  Box() const
  {
    return m_Box;
  }

  /** Words in a row along x. */
  std::size_t
  WordsPerRow() const
  {
    return m_Bits.WordsPerRow();
  }

  /** The row at box-relative y, z (0 <= y < size y, 0 <= z < size z). Threads may write different words. */
  ConstShapeRow
  Row(std::int32_t y, std::int32_t z) const
  {
    return m_Bits.Row(static_cast<std::size_t>(y), static_cast<std::size_t>(z));
  }
  ShapeRow
  Row(std::int32_t y, std::int32_t z)
  {
    return m_Bits.Row(static_cast<std::size_t>(y), static_cast<std::size_t>(z));
  }

  /** The same of any y and z: rows outside the box are background. */
  ConstShapeRow
  RowAnywhere(std::int32_t y, std::int32_t z) const
  {
    return y < 0 || z < 0 || y >= m_Box.size[1] || z >= m_Box.size[2] ? m_Bits.Background() : Row(y, z);
  }

  /** To be called after layers begin to end - 1 (box-relative z) have been written: bricks that have become all in or
   *  all out give their memory back. A brick is eight layers high. */
  void
  Compact(std::int32_t begin, std::int32_t end)
  {
    m_Bits.Compact(static_cast<std::size_t>(begin), static_cast<std::size_t>(end));
  }
  void
  Compact()
  {
    Compact(0, m_Box.size[2]);
  }

  /** Bytes that the bits take. */
  std::size_t
  Bytes() const
  {
    return m_Bits.Bytes();
  }

  /** Whether voxel (x,y,z), in indices of the scan, is in; any index may be asked. */
  bool
  Contains(std::int32_t x, std::int32_t y, std::int32_t z) const
  {
    const auto rx = static_cast<std::uint32_t>(x) - static_cast<std::uint32_t>(m_Box.lower[0]);
    const auto ry = static_cast<std::uint32_t>(y) - static_cast<std::uint32_t>(m_Box.lower[1]);
    const auto rz = static_cast<std::uint32_t>(z) - static_cast<std::uint32_t>(m_Box.lower[2]);
    if (rx >= static_cast<std::uint32_t>(m_Box.size[0]) || ry >= static_cast<std::uint32_t>(m_Box.size[1]) ||
        rz >= static_cast<std::uint32_t>(m_Box.size[2]))
    {
      return false;
    }
    return m_Bits.Get(rx >> 6, ry, rz) >> (rx & 63U) & 1U;
  }

  /** The eight voxels around lattice corner (x,y,z), in coordinates of the scan: bit i + 2 j + 4 k is that of voxel
   *  (x - 1 + i, y - 1 + j, z - 1 + k). Any corner may be asked. */
  unsigned
  Around(std::int32_t x, std::int32_t y, std::int32_t z) const;

  /** Puts voxel (x,y,z), in indices of the scan, in. It must lie in the box. */
  void
  Insert(std::int32_t x, std::int32_t y, std::int32_t z)
  {
    const auto rx = static_cast<std::uint32_t>(x - m_Box.lower[0]);
    Row(y - m_Box.lower[1], z - m_Box.lower[2])[rx >> 6] |= std::uint64_t{ 1 } << (rx & 63U);
  }

  /** Number of voxels that are in. */
  std::uint64_t
  CountVoxels() const;

private:
  VoxelBox  m_Box;
  BitBricks m_Bits;
};

inline unsigned
VoxelShape::Around(std::int32_t x, std::int32_t y, std::int32_t z) const
{
  const auto below = [&](std::int32_t at, std::size_t axis) { return std::int64_t{ at } - m_Box.lower[axis] - 1; };
  const auto isWithin = [&](std::int64_t at, std::size_t axis) { return at >= 0 && at + 1 < m_Box.size[axis]; };
  const std::int64_t rx = below(x, 0);
  const std::int64_t ry = below(y, 1);
  const std::int64_t rz = below(z, 2);
  unsigned           in = 0;
  if (!isWithin(rx, 0) || !isWithin(ry, 1) || !isWithin(rz, 2))
  {
    for (std::int32_t c = 0; c < 8; ++c)
    {
      in |= (Contains(x - 1 + (c & 1), y - 1 + (c >> 1 & 1), z - 1 + (c >> 2)) ? 1U : 0U) << c;
    }
    return in;
  }
  const auto     word = static_cast<std::size_t>(rx) >> 6U;
  const unsigned shift = static_cast<unsigned>(rx) & 63U;
  for (unsigned row = 0; row < 4; ++row)
  {
    const auto ownY = static_cast<std::size_t>(ry) + (row & 1U);
    const auto ownZ = static_cast<std::size_t>(rz) + (row >> 1U);
    auto       pair = static_cast<unsigned>(m_Bits.Get(word, ownY, ownZ) >> shift & 3U);
    if (shift == 63)
    {
      pair |= static_cast<unsigned>(m_Bits.Get(word + 1, ownY, ownZ) & 1U) << 1U;
    }
    in |= pair << (2 * row);
  }
  return in;
}

/** Whether a place in lattice coordinates lies in the open shape: every voxel whose closed cube holds it is in. */
bool
ContainsInside(const VoxelShape & shape, const std::array<double, 3> & place);

/** The same voxels in their tight bounding box (empty box for an empty shape). */
VoxelShape
CropToVoxels(const VoxelShape & shape);

/** The same; the shape's memory goes. */
VoxelShape
CropToVoxels(VoxelShape && shape);

} // namespace voxelcore
