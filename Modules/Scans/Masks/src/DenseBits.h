#pragma once
// Small volumes as rows of bits, for what looks at every voxel several times.

#include "BallDilation.h"

#include "voxelcore/Shape/VoxelShape.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace voxelcore
{

/** One bit a voxel, row by row; bits beyond the box are 0. */
class DenseBits
{
public:
  /** All out. */
  explicit DenseBits(const VoxelBox & box);
  /** A shape, in its own box grown by so many voxels on each side. */
  DenseBits(const VoxelShape & shape, const std::array<std::int32_t, 3> & room);

  const VoxelBox &
  Box() const
  {
    return m_Box;
  }
  std::size_t
  WordsPerRow() const
  {
    return m_Words;
  }
  std::uint64_t *
  Row(std::int32_t y, std::int32_t z)
  {
    return m_Bits.data() + PlaceOf(y, z);
  }
  const std::uint64_t *
  Row(std::int32_t y, std::int32_t z) const
  {
    return m_Bits.data() + PlaceOf(y, z);
  }
  /** Of a row's last word, the bits that belong to it. */
  std::uint64_t
  LastWord() const
  {
    return ~std::uint64_t{ 0 } >> (63U - (static_cast<unsigned>(m_Box.size[0] - 1) & 63U));
  }
  std::uint64_t
  Count() const;

  VoxelShape
  ToShape() const;

private:
  std::size_t
  PlaceOf(std::int32_t y, std::int32_t z) const
  {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(m_Box.size[1]) + static_cast<std::size_t>(y)) *
           m_Words;
  }

  VoxelBox                   m_Box;
  std::size_t                m_Words;
  std::vector<std::uint64_t> m_Bits;
};

/** All places within the ball's reach of a voxel, in the shape's box grown by that reach. */
DenseBits
DilatedBits(const VoxelShape & shape, const BallRows & ball);

/** The holes of all slices across all three axes (SliceHoles.h). */
DenseBits
HolesOfAllSlices(const DenseBits & shape);

} // namespace voxelcore
