#pragma once
// The voxel shape: the interior of a union of voxels, as packed bits of its bounding box (paper, section 3.2).

#include "voxelcore/LatticePoint.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace voxelcore
{

/** Voxels lower to lower + size - 1 along each axis, in voxel indices of the scan. */
struct VoxelBox
{
  std::array<std::int32_t, 3> lower{ 0, 0, 0 };
  std::array<std::int32_t, 3> size{ 0, 0, 0 };
};

/** One bit a voxel. Rows run along x in words of 64 voxels, least significant bit first; bits beyond the box are 0.
 *  Everything outside the box is background. Sides up to 2^30. */
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
    return m_WordsPerRow;
  }

  /** The row at box-relative y, z (0 <= y < size y, 0 <= z < size z). */
  std::span<const std::uint64_t>
  Row(std::int32_t y, std::int32_t z) const
  {
    return { m_Words.data() + RowStart(y, z), m_WordsPerRow };
  }
  std::span<std::uint64_t>
  Row(std::int32_t y, std::int32_t z)
  {
    return { m_Words.data() + RowStart(y, z), m_WordsPerRow };
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
    return (m_Words[RowStart(static_cast<std::int32_t>(ry), static_cast<std::int32_t>(rz)) + (rx >> 6)] >> (rx & 63U)) &
           1U;
  }

  /** Puts voxel (x,y,z), in indices of the scan, in. It must lie in the box. */
  void
  Insert(std::int32_t x, std::int32_t y, std::int32_t z)
  {
    const auto rx = static_cast<std::uint32_t>(x - m_Box.lower[0]);
    m_Words[RowStart(y - m_Box.lower[1], z - m_Box.lower[2]) + (rx >> 6)] |= std::uint64_t{ 1 } << (rx & 63U);
  }

  /** Number of voxels that are in. */
  std::uint64_t
  CountVoxels() const;

private:
  std::size_t
  RowStart(std::int32_t y, std::int32_t z) const
  {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(m_Box.size[1]) + static_cast<std::size_t>(y)) *
           m_WordsPerRow;
  }

  friend VoxelShape
  CropToVoxels(VoxelShape && shape);

  VoxelBox                   m_Box;
  std::size_t                m_WordsPerRow = 0;
  std::vector<std::uint64_t> m_Words;
};

/** Whether a place in lattice coordinates lies in the open shape: every voxel whose closed cube holds it is in. */
bool
ContainsInside(const VoxelShape & shape, const std::array<double, 3> & place);

/** The same voxels in their tight bounding box (empty box for an empty shape). */
VoxelShape
CropToVoxels(const VoxelShape & shape);

/** The same in the memory of the shape itself. */
VoxelShape
CropToVoxels(VoxelShape && shape);

} // namespace voxelcore
