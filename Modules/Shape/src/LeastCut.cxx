#include "LeastCut.h"

#include <algorithm>
#include <utility>

namespace voxelcore
{

void
LeastCut::FindLevels(bool isFromFirst)
{
  const std::size_t start = 2 * m_Nodes + (isFromFirst ? 0 : 1);
  m_Level.assign(m_First.size(), kNone);
  std::vector<std::size_t> waiting{ start };
  m_Level[start] = 0;
  for (std::size_t at = 0; at < waiting.size(); ++at)
  {
    for (std::size_t arc = m_First[waiting[at]]; arc != kNone; arc = m_Arcs[arc].next)
    {
      const std::size_t to = m_Arcs[arc].to;
      if (m_Arcs[isFromFirst ? arc : arc ^ 1U].room > 0 && m_Level[to] == kNone)
      {
        m_Level[to] = m_Level[waiting[at]] + 1;
        waiting.push_back(to);
      }
    }
  }
}

/** One way through the levels, without recursion, as ways may be long; 0 when there is none left. */
std::uint64_t
LeastCut::PushOne()
{
  std::vector<std::size_t> way; // arcs
  std::size_t              node = 2 * m_Nodes;
  while (node != 2 * m_Nodes + 1)
  {
    std::size_t & arc = m_Now[node];
    while (arc != kNone && (m_Arcs[arc].room == 0 || m_Level[m_Arcs[arc].to] != m_Level[node] + 1))
    {
      arc = m_Arcs[arc].next;
    }
    if (arc != kNone)
    {
      way.push_back(arc);
      node = m_Arcs[arc].to;
      continue;
    }
    if (way.empty())
    {
      return 0;
    }
    m_Level[node] = kNone; // a dead end
    node = m_Arcs[way.back() ^ 1U].to;
    way.pop_back();
  }
  std::uint64_t most = kStays;
  for (const std::size_t arc : way)
  {
    most = std::min(most, m_Arcs[arc].room);
  }
  for (const std::size_t arc : way)
  {
    m_Arcs[arc].room -= most;
    m_Arcs[arc ^ 1U].room += most;
  }
  return most;
}

std::vector<LeastCut::Result>
LeastCut::Run()
{
  std::uint64_t flow = 0;
  for (FindLevels(true); m_Level[2 * m_Nodes + 1] != kNone; FindLevels(true))
  {
    m_Now = m_First;
    for (std::uint64_t more = PushOne(); more > 0; more = PushOne())
    {
      flow += more;
      if (flow >= kStays)
      {
        return {};
      }
    }
  }
  std::vector<Result> results;
  for (const bool isFromFirst : { true, false })
  {
    FindLevels(isFromFirst);
    Result one{ {}, std::vector<char>(m_Nodes, 0) };
    for (std::size_t node = 0; node < m_Nodes; ++node)
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
