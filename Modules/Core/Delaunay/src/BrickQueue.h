#pragma once
// How two threads share a range of bricks.

#include <cstddef>
#include <mutex>

namespace voxelcore
{

/** Bricks first to last - 1, taken one by one from both ends until the takers meet: whoever is faster takes more. */
class BrickQueue
{
public:
  static constexpr std::size_t none = ~std::size_t{ 0 };

  BrickQueue(std::size_t first, std::size_t last)
    : m_First(first)
    , m_Last(last)
    , m_Low(first)
    , m_High(last)
  {}

  std::size_t
  First() const
  {
    return m_First;
  }
  std::size_t
  Last() const
  {
    return m_Last;
  }

  /** The next brick from the end, or from the start; none when all are taken. */
  std::size_t
  Take(bool fromEnd)
  {
    const std::lock_guard lock(m_Mutex);
    return m_Low == m_High ? none : fromEnd ? --m_High : m_Low++;
  }

  /** How much of all that is, 0 to 1. */
  double
  ShareTaken()
  {
    const std::lock_guard lock(m_Mutex);
    return 1.0 - static_cast<double>(m_High - m_Low) / static_cast<double>(m_Last - m_First);
  }

private:
  std::size_t m_First;
  std::size_t m_Last;
  std::size_t m_Low;
  std::size_t m_High;
  std::mutex  m_Mutex;
};

} // namespace voxelcore
