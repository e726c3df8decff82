#pragma once
// What happens next: a heap of (time, element), ties by element.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace voxelcore
{

struct TimedElement
{
  double        time;
  std::uint32_t element;

  friend bool
  operator<(const TimedElement & a, const TimedElement & b)
  {
    return a.time != b.time ? a.time < b.time : a.element < b.element;
  }
};

/** Four children a node: half as deep as a binary heap, and siblings share a cache line. */
class TimeHeap
{
public:
  bool
  IsEmpty() const
  {
    return m_Items.empty();
  }

  void
  Push(const TimedElement & item)
  {
    std::size_t at = m_Items.size();
    m_Items.push_back(item);
    while (at > 0)
    {
      const std::size_t parent = (at - 1) / 4;
      if (!(item < m_Items[parent]))
      {
        break;
      }
      m_Items[at] = m_Items[parent];
      at = parent;
    }
    m_Items[at] = item;
  }

  TimedElement
  Pop()
  {
    const TimedElement top = m_Items.front();
    const TimedElement last = m_Items.back();
    m_Items.pop_back();
    const std::size_t count = m_Items.size();
    for (std::size_t at = 0; count > 0;)
    {
      const std::size_t first = 4 * at + 1;
      std::size_t       least = first;
      for (std::size_t child = first + 1; child < std::min(first + 4, count); ++child)
      {
        least = m_Items[child] < m_Items[least] ? child : least;
      }
      if (first >= count || !(m_Items[least] < last))
      {
        m_Items[at] = last;
        break;
      }
      m_Items[at] = m_Items[least];
      at = least;
    }
    return top;
  }

private:
  std::vector<TimedElement> m_Items;
};

} // namespace voxelcore
