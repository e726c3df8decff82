#pragma once
// The levels at which pruning by tolerance takes elements away.

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace voxelcore
{

/** Heights from 0 up: kSteps to a voxel's diagonal as far as gaps are measured, then in steps of the same proportion.
 *  They lie in the middle between round multiples of the diagonal, so that rounding decides nothing where such a height
 *  is asked for. The last one is above all costs. */
class ToleranceLevels
{
public:
  // Up to so many voxel diagonals heights are measured. Ends of long curves drag along all that their lost parts kept:
  // beyond, the sum of what each vertex stuck out of the next stands for a look at it, which is never too small.
  static constexpr int kMeasured = 4;
  static constexpr int kSteps = 80;

  explicit ToleranceLevels(double diagonal)
    : m_Diagonal(diagonal)
  {
    for (int step = 0; step < kMeasured * kSteps; ++step)
    {
      m_Heights.push_back((step + 0.5) * diagonal / kSteps);
    }
    while (m_Heights.back() < 1e9 * diagonal)
    {
      m_Heights.push_back(m_Heights.back() * (1 + 1.0 / (kMeasured * kSteps)));
    }
    m_Heights.push_back(std::numeric_limits<double>::max());
  }

  std::size_t
  Count() const
  {
    return m_Heights.size();
  }
  double
  Height(std::size_t level) const
  {
    return m_Heights[level];
  }
  /** The first that is not below a cost. */
  std::size_t
  LevelOf(double cost) const
  {
    if (cost > m_Heights[kMeasured * kSteps - 1])
    {
      return static_cast<std::size_t>(std::lower_bound(m_Heights.begin(), m_Heights.end(), cost) - m_Heights.begin());
    }
    auto level = static_cast<std::size_t>(cost / m_Diagonal * kSteps); // or one less
    return m_Heights[level] < cost ? level + 1 : level;
  }
  double
  Diagonal() const
  {
    return m_Diagonal;
  }
  /** Up to which gaps are looked at. */
  double
  Measured() const
  {
    return kMeasured * m_Diagonal;
  }

private:
  double              m_Diagonal;
  std::vector<double> m_Heights;
};

/** Adds what is to be looked at when a level comes. Most levels get so few that growing one by one would cost more. */
template <typename Element>
void
AddToTurn(std::vector<Element> & turn, const Element & element)
{
  constexpr std::size_t kUsual = 32;
  if (turn.capacity() == 0)
  {
    turn.reserve(kUsual);
  }
  turn.push_back(element);
}

} // namespace voxelcore
