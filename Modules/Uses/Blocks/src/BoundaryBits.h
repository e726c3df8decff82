#pragma once
// Boundary vertices of parts of a shape, straight from its packed bits.

#include "voxelcore/Shape/VoxelShape.h"

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
  {}

  /** Calls visit(word, bits) for those of the words first .. end - 1 of a row that are not 0: bit b, from the least
   *  significant one on, is the corner at x = 64 word + b. Any row may be asked, and words from 0 on. */
  template <typename TVisit>
  void
  VisitWords(std::int32_t y, std::int32_t z, std::int32_t first, std::int32_t end, TVisit visit) const
  {
    const auto a = m_Shape.RowAnywhere(y - 1, z - 1);
    const auto b = m_Shape.RowAnywhere(y, z - 1);
    const auto c = m_Shape.RowAnywhere(y - 1, z);
    const auto d = m_Shape.RowAnywhere(y, z);
    const auto words = static_cast<std::int32_t>(m_Shape.WordsPerRow());
    const auto anyAt = [&](std::int32_t w) { return w < words ? At(a, w) | At(b, w) | At(c, w) | At(d, w) : 0; };
    const auto allAt = [&](std::int32_t w) { return w < words ? At(a, w) & At(b, w) & At(c, w) & At(d, w) : 0; };
    // Corner x lies between voxels x - 1 and x.
    std::uint64_t carryAny = first > 0 ? anyAt(first - 1) >> 63 : 0;
    std::uint64_t carryAll = first > 0 ? allAt(first - 1) >> 63 : 0;
    for (std::int32_t word = first; word < end && word <= words; ++word)
    {
      const std::uint64_t any = anyAt(word);
      const std::uint64_t all = allAt(word);
      const std::uint64_t bits = (any | any << 1 | carryAny) & ~(all & (all << 1 | carryAll));
      carryAny = any >> 63;
      carryAll = all >> 63;
      if (bits != 0)
      {
        visit(word, bits);
      }
    }
  }

  /** Whether a corner of the box is a boundary vertex. */
  bool
  Contains(std::int32_t x, std::int32_t y, std::int32_t z) const
  {
    bool is = false;
    VisitWords(y, z, x >> 6, (x >> 6) + 1, [&](std::int32_t, std::uint64_t bits) {
      is = (bits >> (x & 63) & 1U) != 0;
    });
    return is;
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
        VisitWords(y, z, lower.x >> 6, (upper.x + 63) >> 6, [&](std::int32_t word, std::uint64_t bits) {
          for (bits &= Between(lower.x, upper.x, word); bits != 0; bits &= bits - 1)
          {
            visit((word << 6) + std::countr_zero(bits), y, z);
          }
        });
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
  static std::uint64_t
  At(const ConstShapeRow & row, std::int32_t word)
  {
    return row[static_cast<std::size_t>(word)];
  }

  const VoxelShape & m_Shape;
};

} // namespace voxelcore
