#pragma once
// Facets known from one side only, found again by their points when the other side turns up.

#include "voxelcore/Base/Prefetch.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace voxelcore
{

/** Names a convex polygon among the facets of one Delaunay tessellation: its smallest point and the two points beside
 *  it, the smaller first. Different facets share at most two points. */
using FacetKey = std::array<std::uint32_t, 3>;

inline FacetKey
KeyOf(std::span<const std::uint32_t> polygon)
{
  // Nearly all have three or four: without branches that nobody can foretell.
  if (polygon.size() == 3)
  {
    const std::uint32_t low = std::min(polygon[0], polygon[1]);
    const std::uint32_t high = std::max(polygon[0], polygon[1]);
    const std::uint32_t rest = std::max(low, polygon[2]);
    return { std::min(low, polygon[2]), std::min(high, rest), std::max(high, rest) };
  }
  if (polygon.size() == 4)
  {
    const std::uint32_t even = std::min(polygon[0], polygon[2]);
    const std::uint32_t odd = std::min(polygon[1], polygon[3]);
    const std::uint32_t one = even < odd ? polygon[1] : polygon[0];
    const std::uint32_t other = even < odd ? polygon[3] : polygon[2];
    return { std::min(even, odd), std::min(one, other), std::max(one, other) };
  }
  const auto least = static_cast<std::size_t>(std::min_element(polygon.begin(), polygon.end()) - polygon.begin());
  const std::uint32_t before = polygon[least == 0 ? polygon.size() - 1 : least - 1];
  const std::uint32_t behind = polygon[least + 1 == polygon.size() ? 0 : least + 1];
  return { polygon[least], std::min(before, behind), std::max(before, behind) };
}

// By hand: compilers make a call to memcmp of the arrays' own comparison.
inline bool
IsSameKey(const FacetKey & a, const FacetKey & b)
{
  return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/** A hash table from FacetKey to a number, by linear probing. */
class FacetTable
{
public:
  static constexpr std::uint32_t none = 0xFFFFFFFFU;

  FacetTable()
    : m_Slots(1024, Slot{ {}, none })
  {}

  /** Makes the table empty, with room for about `expected` entries. */
  void
  Clear(std::size_t expected)
  {
    m_Slots.assign(std::bit_ceil(std::max<std::size_t>(2 * expected, 1024)), Slot{ {}, none });
    m_Size = 0;
  }

  std::size_t
  Size() const
  {
    return m_Size;
  }

  /** Has memory fetch the place where a key will be looked for. */
  void
  Fetch(const FacetKey & key) const
  {
    FetchLine(m_Slots.data() + Home(key));
  }

  /** Takes the number stored under the key out and returns it, or none. */
  std::uint32_t
  Take(const FacetKey & key)
  {
    std::size_t at = Home(key);
    for (; m_Slots[at].value == none || !IsSameKey(m_Slots[at].key, key); at = Next(at))
    {
      if (m_Slots[at].value == none)
      {
        return none;
      }
    }
    return TakeAt(at);
  }

  /** Takes the number stored under the key out and returns it; where there is none, stores another one and returns
   *  none. */
  std::uint32_t
  TakeOrInsert(const FacetKey & key, std::uint32_t value)
  {
    std::size_t at = Home(key);
    for (; m_Slots[at].value != none; at = Next(at))
    {
      if (IsSameKey(m_Slots[at].key, key))
      {
        return TakeAt(at);
      }
    }
    if (2 * (m_Size + 1) > m_Slots.size())
    {
      Insert(key, value);
    }
    else
    {
      m_Slots[at] = { key, value };
      ++m_Size;
    }
    return none;
  }

  /** Stores a number under a key that is not there yet. */
  void
  Insert(const FacetKey & key, std::uint32_t value)
  {
    if (2 * (m_Size + 1) > m_Slots.size())
    {
      std::vector<Slot> old(2 * m_Slots.size(), Slot{ {}, none });
      old.swap(m_Slots);
      m_Size = 0;
      for (const Slot & slot : old)
      {
        if (slot.value != none)
        {
          Insert(slot.key, slot.value);
        }
      }
    }
    std::size_t at = Home(key);
    while (m_Slots[at].value != none)
    {
      at = Next(at);
    }
    m_Slots[at] = { key, value };
    ++m_Size;
  }

  /** Calls visit(key, value) for every entry, in no particular order. */
  template <typename TVisit>
  void
  ForEach(TVisit visit) const
  {
    for (const Slot & slot : m_Slots)
    {
      if (slot.value != none)
      {
        visit(slot.key, slot.value);
      }
    }
  }

private:
  struct Slot
  {
    FacetKey      key;
    std::uint32_t value;
  };

  std::uint32_t
  TakeAt(std::size_t at)
  {
    const std::uint32_t value = m_Slots[at].value;
    // Close the gap with entries that may stand there, so that probing needs no tombstones.
    for (std::size_t gap = at, from = Next(at);; from = Next(from))
    {
      if (m_Slots[from].value == none)
      {
        m_Slots[gap].value = none;
        break;
      }
      const std::size_t mask = m_Slots.size() - 1;
      if (((from - Home(m_Slots[from].key)) & mask) >= ((from - gap) & mask))
      {
        m_Slots[gap] = m_Slots[from];
        gap = from;
      }
    }
    --m_Size;
    return value;
  }

  std::size_t
  Home(const FacetKey & key) const
  {
    std::uint64_t h = (std::uint64_t{ key[0] } << 32 | key[1]) * 0x9E3779B97F4A7C15U;
    h = (h ^ (h >> 29) ^ key[2]) * 0xD6E8FEB86659FD93U;
    return static_cast<std::size_t>(h >> 20) & (m_Slots.size() - 1);
  }
  std::size_t
  Next(std::size_t at) const
  {
    return (at + 1) & (m_Slots.size() - 1);
  }

  std::vector<Slot> m_Slots;
  std::size_t       m_Size = 0;
};

} // namespace voxelcore
