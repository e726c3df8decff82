#pragma once
// The facets a tracer knows from one side only: those of the brick it is in apart, so that they stay in the caches.

#include "FacetTable.h"

namespace voxelcore
{

/** As FacetTable, in two tables. Nearly all facets meet their other side in the brick that made them; of what earlier
 *  bricks left, a facet is asked for only where all its points are known to have some. */
class FacetFront
{
public:
  explicit FacetFront(std::size_t points)
    : m_HasFar((points + 63) / 64, 0)
  {}

  /** Starts with about so many facets of earlier bricks, which come by InsertFar(). */
  void
  Clear(std::size_t expectedFar)
  {
    m_Near.Clear(0);
    m_Far.Clear(expectedFar);
  }

  /** What is there so far belongs to earlier bricks; the next one is expected to make about so many facets at a
   *  time. */
  void
  StartBrick(std::size_t expected)
  {
    m_Near.ForEach([&](const FacetKey & key, std::uint32_t facet) { InsertFar(key, facet); });
    m_Near.Clear(expected);
  }

  /** Has memory fetch the place where a key will be looked for among the brick's own. */
  void
  Fetch(const FacetKey & key) const
  {
    m_Near.Fetch(key);
  }

  /** The same among those of earlier bricks. */
  void
  FetchFar(const FacetKey & key) const
  {
    m_Far.Fetch(key);
  }

  void
  InsertFar(const FacetKey & key, std::uint32_t facet)
  {
    m_Far.Insert(key, facet);
    for (const std::uint32_t point : key)
    {
      m_HasFar[point / 64] |= std::uint64_t{ 1 } << point % 64;
    }
  }

  /** Takes the facet stored under the key out and returns it; where there is none, stores another one and returns
   *  FacetTable::none. */
  std::uint32_t
  TakeOrInsert(const FacetKey & key, std::uint32_t facet)
  {
    if (HasFar(key[0]) && HasFar(key[1]) && HasFar(key[2]))
    {
      if (const std::uint32_t far = m_Far.Take(key); far != FacetTable::none)
      {
        return far;
      }
    }
    return m_Near.TakeOrInsert(key, facet);
  }

  /** Calls visit(facet) for every one, in no particular order. */
  template <typename TVisit>
  void
  ForEach(TVisit visit) const
  {
    for (const FacetTable * table : { &m_Near, &m_Far })
    {
      table->ForEach([&](const FacetKey &, std::uint32_t facet) { visit(facet); });
    }
  }

private:
  bool
  HasFar(std::uint32_t point) const
  {
    return (m_HasFar[point / 64] >> point % 64 & 1U) != 0;
  }

  FacetTable                 m_Near;
  FacetTable                 m_Far;
  std::vector<std::uint64_t> m_HasFar; // per boundary vertex, a bit: some facet in m_Far has it
};

} // namespace voxelcore
