#pragma once
// Disjoint sets by path halving; the smaller index becomes the representative, so results do not depend on the order.

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace voxelcore
{

/** Disjoint sets over 0 .. size-1, up to 2^32 - 1 elements. */
class UnionFind
{
public:
  explicit UnionFind(std::size_t size)
  {
    Reset(size);
  }

  /** Sets of one element each, in the memory there is. */
  void
  Reset(std::size_t size)
  {
    m_Parent.resize(size);
    m_Count = size;
    std::iota(m_Parent.begin(), m_Parent.end(), std::uint32_t{ 0 });
  }

  /** The smallest element of the set that holds `element`. */
  std::uint32_t
  Find(std::size_t element)
  {
    auto e = static_cast<std::uint32_t>(element);
    while (m_Parent[e] != e)
    {
      m_Parent[e] = m_Parent[m_Parent[e]];
      e = m_Parent[e];
    }
    return e;
  }

  /** Makes one set of two. */
  void
  Unite(std::size_t a, std::size_t b)
  {
    const std::uint32_t rootA = Find(a);
    const std::uint32_t rootB = Find(b);
    if (rootA != rootB)
    {
      m_Parent[rootA > rootB ? rootA : rootB] = rootA > rootB ? rootB : rootA;
      --m_Count;
    }
  }

  /** Number of sets. */
  std::size_t
  Count() const
  {
    return m_Count;
  }

private:
  std::vector<std::uint32_t> m_Parent;
  std::size_t                m_Count = 0;
};

} // namespace voxelcore
