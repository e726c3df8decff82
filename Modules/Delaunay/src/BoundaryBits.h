#pragma once
// Boundary vertices of parts of a shape, straight from its packed bits.

#include "voxelcore/VoxelShape.h"

#include <algorithm>
#include <bit>

namespace voxelcore
{

/** Rows of lattice corners, box-relative: 0 <= x, y, z <= size. */
class BoundaryBits
{
public:
  explicit BoundaryBits(const VoxelShape & shape)
    : m_Shape(shape)
    , m_Words(static_cast<std::int32_t>(shape.WordsPerRow()))
  {}

  /** The corners 64 word .. 64 word + 63 of a row, least significant bit first; any row and word may be asked. */
  std::uint64_t
  Word(std::int32_t y, std::int32_t z, std::int32_t word) const
  {
    Quad here = At(y, z, word);
    if (here.any == 0 && word == 0)
    {
      return 0;
    }
    // Corner x lies between voxels x - 1 and x.
    const Quad before = At(y, z, word - 1);
    return (here.any | here.any << 1 | before.any >> 63) & ~(here.all & (here.all << 1 | before.all >> 63));
  }

  /** Calls visit(x, y, z) for the boundary vertices lower <= (x,y,z) < upper, in scan order, all box-relative. */
  template <typename TVisit>
  void
  Visit(const LatticePoint & lower, const LatticePoint & upper, TVisit visit) const
  {
    for (std::int32_t z = lower.z; z < upper.z; ++z)
    {
      for (std::int32_t y = lower.y; y < upper.y; ++y)
      {
        for (std::int32_t word = lower.x >> 6; word << 6 < upper.x; ++word)
        {
          for (std::uint64_t bits = Word(y, z, word) & Between(lower.x, upper.x, word); bits != 0; bits &= bits - 1)
          {
            visit((word << 6) + std::countr_zero(bits), y, z);
          }
        }
      }
    }
  }

  /** The bits of a word whose places lie in first .. end - 1. */
  static std::uint64_t
  Between(std::int32_t first, std::int32_t end, std::int32_t word)
  {
    const std::int32_t low = std::clamp(first - (word << 6), 0, 64);
    const std::int32_t high = std::clamp(end - (word << 6), 0, 64);
    return low >= high ? 0 : (~std::uint64_t{ 0 } << low) & (~std::uint64_t{ 0 } >> (64 - high));
  }

private:
  // The voxels of the four rows around a row of corners: in any of them, in all of them.
  struct Quad
  {
    std::uint64_t any = 0;
    std::uint64_t all = 0;
  };

  Quad
  At(std::int32_t y, std::int32_t z, std::int32_t word) const
  {
    Quad quad{ 0, ~std::uint64_t{ 0 } };
    if (word < 0 || word >= m_Words)
    {
      return {};
    }
    for (std::int32_t corner = 0; corner < 4; ++corner)
    {
      const std::int32_t  vy = y - 1 + (corner & 1);
      const std::int32_t  vz = z - 1 + (corner >> 1);
      const bool          inBox = vy >= 0 && vz >= 0 && vy < m_Shape.Box().size[1] && vz < m_Shape.Box().size[2];
      const std::uint64_t bits = inBox ? m_Shape.Row(vy, vz)[static_cast<std::size_t>(word)] : 0;
      quad.any |= bits;
      quad.all &= bits;
    }
    return quad;
  }

  const VoxelShape & m_Shape;
  std::int32_t       m_Words;
};

} // namespace voxelcore
