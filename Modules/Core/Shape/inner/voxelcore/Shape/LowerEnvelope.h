#pragma once
// The least of many parabolas: squared distances along a row of places to the nearest of others (Meijster, Roerdink,
// Hesselink 2000), in integers.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace voxelcore
{

/** The lower envelope of parabolas value + weight^2 (at - place)^2 over whole numbers `at` from 0 on. */
class LowerEnvelope
{
public:
  LowerEnvelope(std::int64_t weight, std::int32_t count)
    : m_Squared(weight * weight)
    , m_Count(count)
  {}

  void
  Clear()
  {
    m_Parts.clear();
  }

  bool
  IsEmpty() const
  {
    return m_Parts.empty();
  }

  /** Places come in ascending order, and may be below 0. */
  void
  Add(std::int32_t place, std::int64_t value)
  {
    Part part{ value, place, 0 };
    while (!m_Parts.empty() && At(m_Parts.back(), m_Parts.back().first) > At(part, m_Parts.back().first))
    {
      m_Parts.pop_back();
    }
    if (!m_Parts.empty())
    {
      // The last number at which the part before is no greater; it is so at that part's first, which is not below 0.
      const Part &       before = m_Parts.back();
      const std::int64_t step = std::int64_t{ place } - before.place;
      const std::int64_t sum = std::int64_t{ place } + before.place;
      const std::int64_t last = (m_Squared * step * sum + value - before.value) / (2 * m_Squared * step);
      if (last + 1 >= m_Count)
      {
        return;
      }
      part.first = static_cast<std::int32_t>(last + 1);
    }
    m_Parts.push_back(part);
  }

  /** Calls work(at, least) for all numbers below the count. */
  template <typename TWork>
  void
  ForAll(const TWork & work) const
  {
    for (std::size_t i = 0; i < m_Parts.size(); ++i)
    {
      const std::int32_t end = i + 1 < m_Parts.size() ? m_Parts[i + 1].first : m_Count;
      for (std::int32_t at = m_Parts[i].first; at < end; ++at)
      {
        work(at, At(m_Parts[i], at));
      }
    }
  }

private:
  struct Part
  {
    std::int64_t value;
    std::int32_t place;
    std::int32_t first; ///< number at which it is the least
  };

  std::int64_t
  At(const Part & part, std::int32_t at) const
  {
    const std::int64_t step = std::int64_t{ at } - part.place;
    return part.value + m_Squared * step * step;
  }

  std::int64_t      m_Squared;
  std::int32_t      m_Count;
  std::vector<Part> m_Parts;
};

} // namespace voxelcore
