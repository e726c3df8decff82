#pragma once
// Whether an element is still there, and what is asked of it meanwhile and afterwards.

#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Complex/CellComplex.h"

#include <bit>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

namespace voxelcore
{

inline constexpr double kBelowFloor = -1; ///< the height of what a floor took

/** While an element is there, its cofaces; then the height at which it went: in one word, as collapses jump about in
 *  memory and ask for both. Heights are -1, 0 or more; their two highest bits are never both set. Up to kMostCofaces
 *  cofaces, each with a number below kMostSides that says which of its sides the element is. */
class RemainingElements
{
public:
  static constexpr std::uint64_t kMostCofaces = 0xFFFF;
  static constexpr std::uint64_t kMostSides = 0x4000;

  void
  Add(ElementIndex coface, std::uint64_t side = 0)
  {
    if ((m_Word & kCount) == kCount || side >= kMostSides)
    {
      throw std::length_error("an element has too many neighbours to be pruned by tolerance");
    }
    m_Word = (m_Word + kOne) ^ (side << kSideBits | coface);
  }
  void
  Remove(ElementIndex coface, std::uint64_t side = 0)
  {
    m_Word = (m_Word - kOne) ^ (side << kSideBits | coface);
  }
  void
  Go(double height)
  {
    m_Word = bit_cast<std::uint64_t>(height);
  }
  bool
  IsLive() const
  {
    return m_Word >= kLive;
  }
  /** Whether it is there and bounds one element only. */
  bool
  IsFree() const
  {
    return (m_Word & (kLive | kCount)) == (kLive | kOne);
  }
  /** Of one that is there. */
  ElementIndex
  Count() const
  {
    return static_cast<ElementIndex>((m_Word & kCount) >> kCountBits);
  }
  /** The coface of a free one. */
  ElementIndex
  Coface() const
  {
    return static_cast<ElementIndex>(m_Word);
  }
  /** Which side of that coface it is. */
  std::uint64_t
  Side() const
  {
    return m_Word >> kSideBits & (kMostSides - 1);
  }
  /** Of one that went. */
  double
  Height() const
  {
    return bit_cast<double>(m_Word);
  }

private:
  static constexpr unsigned      kSideBits = 32;
  static constexpr unsigned      kCountBits = 46;
  static constexpr std::uint64_t kLive = std::uint64_t{ 3 } << 62U;
  static constexpr std::uint64_t kOne = std::uint64_t{ 1 } << kCountBits;
  static constexpr std::uint64_t kCount = kMostCofaces << kCountBits;

  std::uint64_t m_Word = kLive;
};

/** Infinity for those that are there. */
inline std::vector<double>
HeightsOf(const std::vector<RemainingElements> & elements)
{
  std::vector<double> heights(elements.size());
  RunInParts(elements.size() > 10000, elements.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
    {
      heights[i] = elements[i].IsLive() ? std::numeric_limits<double>::infinity() : elements[i].Height();
    }
  });
  return heights;
}

} // namespace voxelcore
