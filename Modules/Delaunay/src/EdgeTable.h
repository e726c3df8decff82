#pragma once
// Meeting place of the edges around a cavity.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace voxelcore
{

/** Edges of the rim of a cavity, to link the new tetrahedra: each edge comes twice. Open addressing, emptied by a
 *  stamp. */
class EdgeTable
{
public:
  static constexpr std::uint32_t none = 0xFFFFFFFFU;

  /** Forgets everything and makes room. */
  void
  Start(std::size_t edges)
  {
    std::size_t size = m_Slots.size();
    while (size < 4 * edges)
    {
      size *= 2;
    }
    if (size != m_Slots.size())
    {
      m_Slots.assign(size, Slot{});
      m_Stamp = 0;
    }
    ++m_Stamp;
  }

  /** The first time stores the value and returns none; the second time returns what was stored. */
  std::uint32_t
  Meet(std::uint32_t a, std::uint32_t b, std::uint32_t value)
  {
    const std::uint32_t low = std::min(a, b);
    const std::uint32_t high = std::max(a, b);
    const std::size_t   mask = m_Slots.size() - 1;
    for (std::size_t at = (low * 0x9E3779B1U ^ high * 0x85EBCA77U) & mask;; at = (at + 1) & mask)
    {
      Slot & slot = m_Slots[at];
      if (slot.stamp != m_Stamp)
      {
        slot = { m_Stamp, low, high, value };
        return none;
      }
      if (slot.low == low && slot.high == high)
      {
        return slot.value;
      }
    }
  }

private:
  struct Slot
  {
    std::uint32_t stamp = 0, low = 0, high = 0, value = 0;
  };
  std::vector<Slot> m_Slots = std::vector<Slot>(256);
  std::uint32_t     m_Stamp = 0;
};

} // namespace voxelcore
