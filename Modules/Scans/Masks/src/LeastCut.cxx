#include "LeastCut.h"

#include "voxelcore/Base/Library.h"

#include <algorithm>
#include <utility>

namespace voxelcore
{

void
LeastCut::MakeNeighbours()
{
  m_FirstOf.assign(m_Room.size() + 1, 0);
  for (const auto & link : m_Links)
  {
    ++m_FirstOf[link[0] + 1];
    ++m_FirstOf[link[1] + 1];
  }
  for (std::size_t node = 0; node < m_Room.size(); ++node)
  {
    m_FirstOf[node + 1] += m_FirstOf[node];
  }
  m_Neighbour.resize(2 * m_Links.size());
  m_Twin.resize(m_Neighbour.size());
  m_Flow.assign(m_Neighbour.size(), 0);
  std::vector<std::uint32_t> next(m_FirstOf.begin(), m_FirstOf.end() - 1);
  for (const auto & [a, b] : m_Links)
  {
    const std::uint32_t there = next[a]++;
    const std::uint32_t back = next[b]++;
    m_Neighbour[there] = b;
    m_Neighbour[back] = a;
    m_Twin[there] = back;
    m_Twin[back] = there;
  }
}

std::uint32_t
LeastCut::TargetOf(const Step & step) const
{
  return step.number == 0 ? step.half ^ 1U
                          : 2 * m_Neighbour[m_FirstOf[step.half / 2] + step.number - 1] + 1 - step.half % 2;
}

std::uint64_t
LeastCut::RoomOf(const Step & step) const
{
  const std::uint32_t node = step.half / 2;
  const bool          isIn = step.half % 2 == 0;
  if (step.number == 0)
  {
    return isIn ? m_Room[node] : m_Through[node];
  }
  return isIn ? m_Flow[m_Twin[m_FirstOf[node] + step.number - 1]] : kStays;
}

void
LeastCut::Flow(const Step & step, std::uint64_t by)
{
  const std::uint32_t node = step.half / 2;
  const bool          isIn = step.half % 2 == 0;
  if (step.number == 0)
  {
    (isIn ? m_Room : m_Through)[node] -= by;
    (isIn ? m_Through : m_Room)[node] += by;
    return;
  }
  const std::uint32_t at = m_FirstOf[node] + step.number - 1;
  if (isIn)
  {
    m_Flow[m_Twin[at]] -= by;
  }
  else
  {
    m_Flow[at] += by;
  }
}

std::uint32_t
LeastCut::LevelsToSecond(bool onlyToFirst)
{
  m_Level.assign(2 * m_Room.size(), kNone);
  m_Waiting.clear();
  std::uint32_t first = kNone;
  const auto    reach = [&](std::uint32_t half, std::uint32_t level) {
    if (m_Level[half] == kNone)
    {
      m_Level[half] = level;
      m_Waiting.push_back(half);
      if (half % 2 == 0 && m_AtEnd[half / 2][0] != 0)
      {
        first = std::min(first, level + 1);
      }
    }
  };
  for (std::uint32_t node = 0; node < m_Room.size(); ++node)
  {
    if (m_AtEnd[node][1] != 0)
    {
      reach(2 * node + 1, 1);
    }
  }
  for (std::size_t i = 0; i < m_Waiting.size(); ++i)
  {
    const std::uint32_t half = m_Waiting[i];
    const std::uint32_t node = half / 2;
    const std::uint32_t level = m_Level[half] + 1;
    if (onlyToFirst && level >= first)
    {
      break;
    }
    const bool isIn = half % 2 == 0;
    if ((isIn ? m_Through : m_Room)[node] > 0)
    {
      reach(half ^ 1U, level);
    }
    for (std::uint32_t at = m_FirstOf[node]; at < m_FirstOf[node + 1]; ++at)
    {
      if (isIn || m_Flow[at] > 0)
      {
        reach(2 * m_Neighbour[at] + (isIn ? 1 : 0), level);
      }
    }
  }
  return first;
}

void
LeastCut::LevelsFromFirst()
{
  m_Level.assign(2 * m_Room.size(), kNone);
  m_Waiting.clear();
  for (std::uint32_t node = 0; node < m_Room.size(); ++node)
  {
    if (m_AtEnd[node][0] != 0)
    {
      m_Level[2 * node] = 1;
      m_Waiting.push_back(2 * node);
    }
  }
  for (std::size_t i = 0; i < m_Waiting.size(); ++i)
  {
    const std::uint32_t half = m_Waiting[i];
    for (Step step{ half, 0 }; step.number <= Degree(half / 2); ++step.number)
    {
      const std::uint32_t target = TargetOf(step);
      if (m_Level[target] == kNone && RoomOf(step) > 0)
      {
        m_Level[target] = m_Level[half] + 1;
        m_Waiting.push_back(target);
      }
    }
  }
}

/** Without recursion, as ways may be long; after each way on from where it became full. */
std::uint64_t
LeastCut::Push(std::uint32_t from, std::uint64_t limit)
{
  std::uint64_t     sum = 0;
  std::vector<Step> way;
  for (std::uint32_t half = from; sum < limit;)
  {
    if (m_Level[half] == 1 && half % 2 == 1 && m_AtEnd[half / 2][1] != 0)
    {
      std::uint64_t most = kStays;
      for (const Step & step : way)
      {
        most = std::min(most, RoomOf(step));
      }
      sum += most;
      for (const Step & step : way)
      {
        Flow(step, most);
      }
      const auto full = ranges::find_if(way, [&](const Step & step) { return RoomOf(step) == 0; });
      half = full == way.end() ? from : full->half;
      way.erase(full, way.end());
      continue;
    }
    Step step{ half, m_Now[half] };
    while (step.number <= Degree(half / 2) && (m_Level[TargetOf(step)] + 1 != m_Level[half] || RoomOf(step) == 0))
    {
      ++step.number;
    }
    m_Now[half] = step.number;
    if (step.number <= Degree(half / 2))
    {
      way.push_back(step);
      half = TargetOf(step);
      continue;
    }
    m_Level[half] = kNone - 1; // a dead end
    if (way.empty())
    {
      break;
    }
    half = way.back().half;
    way.pop_back();
  }
  return sum;
}

std::vector<LeastCut::Result>
LeastCut::Run(std::uint64_t limit)
{
  limit = std::min(limit, kStays);
  MakeNeighbours();
  std::uint64_t flow = 0;
  for (std::uint32_t first = LevelsToSecond(true); first != kNone && flow < limit; first = LevelsToSecond(true))
  {
    m_Now.assign(2 * m_Room.size(), 0);
    for (std::uint32_t node = 0; node < m_Room.size() && flow < limit; ++node)
    {
      if (m_AtEnd[node][0] != 0 && m_Level[2 * node] + 1 == first)
      {
        flow += Push(2 * node, limit - flow);
      }
    }
  }
  if (flow >= limit)
  {
    return {};
  }
  std::vector<Result> results;
  for (const bool isFromFirst : { true, false })
  {
    if (isFromFirst)
    {
      LevelsFromFirst();
    }
    else
    {
      LevelsToSecond(false);
    }
    Result one{ {}, std::vector<char>(m_Room.size(), 0) };
    for (std::size_t node = 0; node < m_Room.size(); ++node)
    {
      const bool isIn = m_Level[2 * node] != kNone;
      const bool isOut = m_Level[2 * node + 1] != kNone;
      if (isIn != isOut)
      {
        one.nodes.push_back(node);
      }
      one.isFirst[node] = (isIn && isOut) == isFromFirst ? 1 : 0;
    }
    if (results.empty() || results.front().nodes != one.nodes)
    {
      results.push_back(std::move(one));
    }
  }
  return results;
}

} // namespace voxelcore
