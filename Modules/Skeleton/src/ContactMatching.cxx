#include "ContactMatching.h"

#include <algorithm>
#include <utility>

namespace voxelcore
{

Matcher::Matcher(std::vector<std::vector<double>> values)
  : m_Values(std::move(values))
  , m_Taken(m_Values.empty() ? 0 : m_Values.front().size(), 0)
{
  m_Now.partner.assign(m_Values.size(), -1);
  best.value = -1;
  if (m_Values.size() <= 5 && m_Taken.size() <= 7)
  {
    Try(0);
  }
  else
  {
    Greedy();
  }
}

void
Matcher::Try(std::size_t row)
{
  if (row == m_Values.size())
  {
    if (m_Now.value > best.value)
    {
      second = best.value;
      best = m_Now;
    }
    else
    {
      second = std::max(second, m_Now.value);
    }
    return;
  }
  for (std::size_t column = 0; column < m_Taken.size(); ++column)
  {
    if (m_Taken[column] || !(m_Values[row][column] > 0))
    {
      continue;
    }
    m_Taken[column] = 1;
    m_Now.partner[row] = static_cast<int>(column);
    m_Now.value += m_Values[row][column];
    Try(row + 1);
    m_Now.value -= m_Values[row][column];
    m_Now.partner[row] = -1;
    m_Taken[column] = 0;
  }
  Try(row + 1);
}

void
Matcher::Greedy()
{
  best = m_Now;
  best.value = 0;
  for (;;)
  {
    double      most = 0;
    std::size_t bestRow = 0;
    std::size_t bestColumn = 0;
    for (std::size_t row = 0; row < m_Values.size(); ++row)
    {
      for (std::size_t column = 0; column < m_Taken.size(); ++column)
      {
        if (best.partner[row] < 0 && !m_Taken[column] && m_Values[row][column] > most)
        {
          most = m_Values[row][column];
          bestRow = row;
          bestColumn = column;
        }
      }
    }
    if (!(most > 0))
    {
      return;
    }
    best.partner[bestRow] = static_cast<int>(bestColumn);
    m_Taken[bestColumn] = 1;
    best.value += most;
  }
}

} // namespace voxelcore
