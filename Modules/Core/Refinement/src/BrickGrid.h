#pragma once
// Bricks of 8^3 cells near a shape's boundary, so that memory follows the boundary.

#include "voxelcore/Base/CountBits.h"
#include "voxelcore/Shape/VoxelShape.h"

#include <cstdint>
#include <memory>
#include <new>
#include <span>
#include <utility>
#include <vector>

namespace voxelcore
{

/** An allocator for values that are all written before they are read: memory is taken where they are written first, by
 *  several threads. */
template <typename T>
struct Unset : std::allocator<T>
{
  template <typename TOther>
  struct rebind
  {
    using other = Unset<TOther>;
  };
  template <typename TOther>
  void
  construct(TOther * place)
  {
    ::new (static_cast<void *>(place)) TOther;
  }
  template <typename TOther, typename... TArguments>
  void
  construct(TOther * place, TArguments &&... arguments)
  {
    ::new (static_cast<void *>(place)) TOther(std::forward<TArguments>(arguments)...);
  }
};

/** The bricks within some voxels of a boundary, by (z, y, x). Cells are voxels, or cubes of 2^3 of them. */
class BrickGrid
{
public:
  static constexpr std::int32_t   kSide = 8;
  static constexpr std::size_t    kCells = 512;
  static constexpr std::ptrdiff_t kMany = 256; ///< fewer are not worth several threads that wait for each other
  static constexpr std::int32_t   kOutside = -1;
  static constexpr std::int32_t   kInside = -2;
  static constexpr std::size_t    kSelf = 13; ///< among the neighbours
  using Brick = std::array<std::int32_t, 3>;
  using Flags = std::array<std::uint8_t, 64>; ///< of a brick's cells: a byte a row along x

  /** What is within `reach` voxels of a boundary vertex has a brick; the sides of a cell are 2^level voxels. */
  BrickGrid(const VoxelShape & shape, std::span<const LatticePoint> points, int level, std::int32_t reach);

  /** Those of another one's bricks that are wanted. */
  BrickGrid(const VoxelShape & shape, const BrickGrid & other, const std::vector<std::uint8_t> & wanted);

  std::size_t
  Count() const
  {
    return m_Bricks.size();
  }

  /** In units of bricks. */
  const Brick &
  At(std::size_t brick) const
  {
    return m_Bricks[brick];
  }

  /** Its index, kOutside when there is none. */
  std::int32_t
  Find(const Brick & brick) const
  {
    const std::size_t bit = BitOf(brick);
    if (bit >= m_BitCount || (m_Bits[bit >> 6] >> (bit & 63) & 1) == 0)
    {
      return kOutside;
    }
    const std::uint64_t below = m_Bits[bit >> 6] & ((std::uint64_t{ 1 } << (bit & 63)) - 1);
    return static_cast<std::int32_t>(m_Ranks[bit >> 6] + CountBits(below));
  }

  /** Of a brick and those around it, by x, then y, then z: their indices, kOutside or kInside where there is none. */
  const std::array<std::int32_t, 27> &
  Neighbours(std::size_t brick) const
  {
    return m_Neighbours[brick];
  }

  /** Flags of bricks, and of those around them. */
  std::vector<std::uint8_t>
  AndAround(const std::vector<std::uint8_t> & flags) const;

private:
  void
  ListBricks(const VoxelShape & shape);
  std::size_t
  BitOf(const Brick & brick) const
  {
    std::size_t bit = 0;
    for (std::size_t axis = 3; axis-- > 0;)
    {
      const auto at = static_cast<std::uint32_t>(brick[axis] - m_Lower[axis]);
      if (at >= m_Size[axis])
      {
        return m_BitCount;
      }
      bit = bit * m_Size[axis] + at;
    }
    return bit;
  }

  int                                       m_Shift = 0; ///< of a brick's side
  Brick                                     m_Lower{};
  std::array<std::uint32_t, 3>              m_Size{};
  std::size_t                               m_BitCount = 0;
  std::vector<std::uint64_t>                m_Bits;
  std::vector<std::uint32_t>                m_Ranks; ///< bricks before each word
  std::vector<Brick>                        m_Bricks;
  std::vector<std::array<std::int32_t, 27>> m_Neighbours;
};

/** Voxels (x, y, z) to (x + 63, y, z) of a shape as bits. */
inline std::uint64_t
BitsOfRow(const VoxelShape & shape, std::int32_t x, std::int32_t y, std::int32_t z)
{
  const VoxelBox & box = shape.Box();
  const auto       ry = static_cast<std::int64_t>(y) - box.lower[1];
  const auto       rz = static_cast<std::int64_t>(z) - box.lower[2];
  if (ry < 0 || ry >= box.size[1] || rz < 0 || rz >= box.size[2])
  {
    return 0;
  }
  const auto         row = shape.Row(static_cast<std::int32_t>(ry), static_cast<std::int32_t>(rz));
  const std::int64_t rx = static_cast<std::int64_t>(x) - box.lower[0];
  const auto         word = [&](std::int64_t at) {
    return at >= 0 && at < static_cast<std::int64_t>(row.size()) ? row[static_cast<std::size_t>(at)]
                                                                         : std::uint64_t{ 0 };
  };
  const std::int64_t first = rx >> 6;
  const int          shift = static_cast<int>(rx & 63);
  return shift == 0 ? word(first) : (word(first) >> shift) | (word(first + 1) << (64 - shift));
}

/** The rows of bits of a cube that begins at `lower`: what of it is in the shape, and what is not. */
template <typename TRows>
void
ReadRows(const VoxelShape & shape, const std::array<std::int32_t, 3> & lower, TRows & in, TRows & out)
{
  constexpr std::uint64_t all = ~std::uint64_t{ 0 } >> (64 - TRows::kSide);
  for (std::int32_t z = 0; z < TRows::kSide; ++z)
  {
    for (std::int32_t y = 0; y < TRows::kSide; ++y)
    {
      const std::uint64_t bits = BitsOfRow(shape, lower[0], lower[1] + y, lower[2] + z);
      const auto          row = static_cast<std::size_t>(z * TRows::kSide + y);
      in.bits[row] = bits & all;
      out.bits[row] = ~bits & all;
    }
  }
}

} // namespace voxelcore
