#pragma once
// A queue for collapses: things in order while more arrive.

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <type_traits>
#include <utility>
#include <vector>

namespace voxelcore
{

/** Items in order, smallest first, while more arrive. Those ahead wait in buckets by key; the nearest bucket is sorted,
 *  so that what comes next is known and can be fetched from memory in time; those that arrive for it go to a heap.
 *  An Item has operator< that orders by `double Key() const` first. What waits may be smaller, with the same Key():
 *  wake(waiting) makes an Item of it when its bucket is next. */
template <typename Item, typename Waiting = Item, typename Wake = std::identity>
class BucketQueue
{
public:
  /** Keys are expected between two bounds; buckets are of no use to those beyond. */
  BucketQueue(double least, double greatest, Wake wake = {})
    : m_Wake(std::move(wake))
    , m_Least(least)
    , m_PerUnit(greatest > least ? (bucketCount - 1) / (greatest - least) : 0.0)
    , m_Ahead(bucketCount)
  {}

  void
  Push(const Waiting & item)
  {
    const std::size_t bucket = BucketOf(item.Key());
    if (bucket > m_Bucket)
    {
      m_Ahead[bucket].push_back(item);
      return;
    }
    m_Heap.push_back(m_Wake(item));
    std::push_heap(m_Heap.begin(), m_Heap.end(), IsGreater);
  }

  /** Starts on the bucket that is next. Nothing is left when it returns false. */
  bool
  Prepare()
  {
    while (m_Heap.empty() && m_Next == m_Run.size())
    {
      if (m_Bucket + 1 == bucketCount)
      {
        return false;
      }
      std::vector<Waiting> next;
      next.swap(m_Ahead[++m_Bucket]);
      if constexpr (std::is_same_v<Item, Waiting>)
      {
        m_Run = std::move(next);
      }
      else
      {
        std::vector<Item>().swap(m_Run);
        m_Run.reserve(next.size());
        std::transform(next.begin(), next.end(), std::back_inserter(m_Run), m_Wake);
      }
      std::sort(m_Run.begin(), m_Run.end());
      m_Next = 0;
    }
    return true;
  }

  /** The smallest; Prepare() must have returned true. */
  const Item &
  Top() const
  {
    return IsHeapNext() ? m_Heap.front() : m_Run[m_Next];
  }

  /** Takes the smallest out; Prepare() must have returned true. */
  Item
  Pop()
  {
    if (IsHeapNext())
    {
      std::pop_heap(m_Heap.begin(), m_Heap.end(), IsGreater);
      const Item item = m_Heap.back();
      m_Heap.pop_back();
      return item;
    }
    return m_Run[m_Next++];
  }

  /** The item that comes `steps` later as far as is known, or null. */
  const Item *
  Ahead(std::size_t steps) const
  {
    return m_Next + steps < m_Run.size() ? &m_Run[m_Next + steps] : nullptr;
  }

private:
  static constexpr std::size_t bucketCount = 1024;

  static bool
  IsGreater(const Item & a, const Item & b)
  {
    return b < a;
  }

  bool
  IsHeapNext() const
  {
    return m_Next == m_Run.size() || (!m_Heap.empty() && m_Heap.front() < m_Run[m_Next]);
  }

  // Rounding keeps the order: buckets do not fall as keys rise. Bucket 0 stays empty, as none lies before it.
  std::size_t
  BucketOf(double key) const
  {
    if (key <= m_Least)
    {
      return 1;
    }
    const double position = (key - m_Least) * m_PerUnit;
    return position < bucketCount - 2 ? 1 + static_cast<std::size_t>(position) : bucketCount - 1;
  }

  Wake                              m_Wake;
  double                            m_Least;
  double                            m_PerUnit;
  std::vector<std::vector<Waiting>> m_Ahead;
  std::size_t                       m_Bucket = 0; // of the run
  std::vector<Item>                 m_Run;
  std::size_t                       m_Next = 0;
  std::vector<Item>                 m_Heap;
};

} // namespace voxelcore
