#pragma once
// What comes next in time, ties by index.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
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

/** A queue for fires, whose events nearly always lie ahead of the present. What is to come waits unsorted in buckets by
 *  time, as bare indices; when the turn of a bucket comes the times are looked up and sorted. What is added to the
 *  present bucket, or before it, goes to a small heap beside. The order is that of one heap, in a few cache lines
 *  instead of all of memory. */
class TimeHeap
{
public:
  /** `bucket`: time that a bucket spans; changes speed, not the order. Some thousand of them should be enough. */
  explicit TimeHeap(double bucket)
    : m_PerTime(bucket > 0 ? 1 / bucket : 1)
  {}

  void
  Push(const TimedElement & item)
  {
    const std::size_t bucket = BucketOf(item.time);
    if (bucket <= m_Present)
    {
      PushHeap(item);
      return;
    }
    if (bucket >= m_Buckets.size())
    {
      m_Buckets.resize(bucket + 1);
    }
    m_Buckets[bucket].push_back(item.element);
  }

  /** Takes out what is next; false when there is nothing. `due(element)` gives the time an element waits for. */
  template <typename Due>
  bool
  Pop(const Due & due, TimedElement & item)
  {
    while (m_Heap.empty() && m_Next == m_Sorted.size())
    {
      if (m_Present + 1 >= m_Buckets.size())
      {
        return false;
      }
      Open(due);
    }
    if (m_Heap.empty() || (m_Next < m_Sorted.size() && m_Sorted[m_Next] < m_Heap.front()))
    {
      item = m_Sorted[m_Next++];
    }
    else
    {
      item = PopHeap();
    }
    return true;
  }

  /** The element that comes `steps` later as far as is known, or none: for those who fetch what they will need. */
  std::uint32_t
  Ahead(std::size_t steps) const
  {
    return m_Next + steps < m_Sorted.size() ? m_Sorted[m_Next + steps].element : none;
  }

  static constexpr std::uint32_t none = 0xFFFFFFFFU;

private:
  // Times beyond (infinite ones too) share the last bucket.
  static constexpr std::size_t kLastBucket = 4096;

  std::size_t
  BucketOf(double time) const
  {
    const double bucket = time * m_PerTime;
    return bucket < static_cast<double>(kLastBucket) ? static_cast<std::size_t>(std::max(bucket, 0.0)) : kLastBucket;
  }

  /** Makes the next bucket the present one. */
  template <typename Due>
  void
  Open(const Due & due)
  {
    const std::vector<std::uint32_t> elements = std::exchange(m_Buckets[++m_Present], {});
    m_Next = 0;
    m_Unsorted.clear();
    for (const std::uint32_t element : elements)
    {
      m_Unsorted.push_back({ due(element), element });
    }
    SortIntoSlots();
    for (std::size_t slot = 0, first = 0; first < m_Sorted.size(); ++slot)
    {
      const auto own = m_Sorted.begin() + static_cast<std::ptrdiff_t>(first);
      std::sort(own, m_Sorted.begin() + m_SlotEnds[slot]);
      first = m_SlotEnds[slot];
    }
  }

  /** Lays the present bucket down in slots that follow each other, of few elements each: next to nothing is left to
   *  compare. */
  void
  SortIntoSlots()
  {
    const std::size_t slots = m_Unsorted.size() / 2 + 1;
    const double      start = static_cast<double>(m_Present) / m_PerTime;
    const double      perTime = m_PerTime * static_cast<double>(slots);
    const auto        slotOf = [&](double time) {
      const double slot = (time - start) * perTime;
      return slot < static_cast<double>(slots - 1) ? static_cast<std::size_t>(std::max(slot, 0.0)) : slots - 1;
    };
    m_SlotEnds.assign(slots + 1, 0); // one place behind while it is filled, so that starts become ends
    for (const TimedElement & item : m_Unsorted)
    {
      ++m_SlotEnds[slotOf(item.time) + 1];
    }
    for (std::size_t slot = 1; slot <= slots; ++slot)
    {
      m_SlotEnds[slot] += m_SlotEnds[slot - 1];
    }
    m_Sorted.resize(m_Unsorted.size());
    for (const TimedElement & item : m_Unsorted)
    {
      m_Sorted[m_SlotEnds[slotOf(item.time)]++] = item;
    }
  }

  /** Four children a node: half as deep as a binary heap, and siblings share a cache line. */
  void
  PushHeap(const TimedElement & item)
  {
    std::size_t at = m_Heap.size();
    m_Heap.push_back(item);
    while (at > 0)
    {
      const std::size_t parent = (at - 1) / 4;
      if (!(item < m_Heap[parent]))
      {
        break;
      }
      m_Heap[at] = m_Heap[parent];
      at = parent;
    }
    m_Heap[at] = item;
  }

  TimedElement
  PopHeap()
  {
    const TimedElement top = m_Heap.front();
    const TimedElement last = m_Heap.back();
    m_Heap.pop_back();
    const std::size_t count = m_Heap.size();
    for (std::size_t at = 0; count > 0;)
    {
      const std::size_t first = 4 * at + 1;
      std::size_t       least = first;
      for (std::size_t child = first + 1; child < std::min(first + 4, count); ++child)
      {
        least = m_Heap[child] < m_Heap[least] ? child : least;
      }
      if (first >= count || !(m_Heap[least] < last))
      {
        m_Heap[at] = last;
        break;
      }
      m_Heap[at] = m_Heap[least];
      at = least;
    }
    return top;
  }

  double                                  m_PerTime;
  std::vector<std::vector<std::uint32_t>> m_Buckets;  ///< to come; those up to m_Present are empty
  std::vector<TimedElement>               m_Unsorted; ///< the present bucket, as it came
  std::vector<TimedElement>               m_Sorted;   ///< the present bucket, from m_Next on
  std::vector<std::uint32_t>              m_SlotEnds; ///< of its slots
  std::vector<TimedElement>               m_Heap;     ///< came in when their bucket was present or past
  std::size_t                             m_Present = 0;
  std::size_t                             m_Next = 0;
};

/** The time a bucket spans for fire on a surface with these radii, which is where most of it is at any moment. */
inline double
FireBucket(const std::vector<double> & radius)
{
  double sum = 0;
  for (const double one : radius)
  {
    sum += one;
  }
  return radius.empty() ? 1 : sum / (16 * static_cast<double>(radius.size()));
}

} // namespace voxelcore
