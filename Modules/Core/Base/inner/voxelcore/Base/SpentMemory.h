#pragma once
// Arrays whose memory is given back before all of them is used up.

#include "voxelcore/Base/SystemCalls.h"

#include <cstddef>
#include <span>
#include <vector>

namespace voxelcore
{

/** An array that is used up from its front on: what has been used is given back while the rest is still in use. The
 *  array outlives the object. What was given back must not be read again. */
template <typename T>
class SpentFront
{
public:
  explicit SpentFront(std::span<T> array)
    : m_Array(array)
  {}
  explicit SpentFront(std::vector<T> & array)
    : m_Array(array)
  {}

  /** The elements before `count` will not be asked for again. */
  void
  SpendTo(std::size_t count)
  {
    if (count > m_Spent)
    {
      m_Spent += ReleaseMemory(m_Array.data() + m_Spent, (count - m_Spent) * sizeof(T)) / sizeof(T);
    }
  }

private:
  std::span<T> m_Array;
  std::size_t  m_Spent = 0;
};

/** Shortens an array, and gives back what the end took up: of a large one without a copy of the rest, as
 *  shrink_to_fit() makes it. The system takes back large pages only, so that a small one is copied. */
template <typename T>
void
CutShort(std::vector<T> & array, std::size_t count)
{
  constexpr std::size_t small = std::size_t{ 4 } << 20; // bytes
  if (array.size() * sizeof(T) > small)
  {
    ReleaseMemory(array.data() + count, (array.size() - count) * sizeof(T));
    array.resize(count);
  }
  else
  {
    array.resize(count);
    array.shrink_to_fit();
  }
}

} // namespace voxelcore
