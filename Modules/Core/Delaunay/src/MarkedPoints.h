#pragma once
// Some of many points, numbered, in two bits a point.

#include "voxelcore/Base/CountBits.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace voxelcore
{

/** Some of many points, and their numbers among these. */
class MarkedPoints
{
public:
  explicit MarkedPoints(std::size_t points = 0)
    : m_Bits((points + 63) / 64, 0)
  {}

  void
  Mark(std::span<const std::uint32_t> points)
  {
    for (const std::uint32_t point : points)
    {
      m_Bits[point / 64] |= std::uint64_t{ 1 } << point % 64;
    }
  }
  bool
  IsMarked(std::uint32_t point) const
  {
    return (m_Bits[point / 64] >> point % 64 & 1U) != 0;
  }
  /** Numbers what is marked. */
  std::size_t
  Count()
  {
    m_Before.resize(m_Bits.size());
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < m_Bits.size(); ++i)
    {
      m_Before[i] = count;
      count += CountBits(m_Bits[i]);
    }
    return count;
  }
  std::size_t
  NumberOf(std::uint32_t point) const
  {
    return m_Before[point / 64] + CountBits(m_Bits[point / 64] & ((std::uint64_t{ 1 } << point % 64) - 1));
  }

private:
  std::vector<std::uint64_t> m_Bits;
  std::vector<std::uint32_t> m_Before;
};

} // namespace voxelcore
