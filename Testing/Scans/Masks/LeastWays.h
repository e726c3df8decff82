#pragma once
// What parts voxels at the least cost, and what joins them, by methods for whole graphs.

#include "GreyCase.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace voxelcore::testing
{

using VoxelPlace = std::array<std::int32_t, 3>;

/** The voxels of a case by number. */
class GreyGrid
{
public:
  explicit GreyGrid(const GreyCase & grey)
    : m_Grey(grey)
  {}

  std::size_t
  Count() const
  {
    return m_Grey.grey.size();
  }

  VoxelPlace
  At(std::size_t voxel) const
  {
    const auto x = static_cast<std::size_t>(m_Grey.size[0]);
    const auto y = static_cast<std::size_t>(m_Grey.size[1]);
    return { static_cast<std::int32_t>(voxel % x),
             static_cast<std::int32_t>(voxel / x % y),
             static_cast<std::int32_t>(voxel / x / y) };
  }

  /** Calls visit(other) for neighbours that share at most `corners` + 1 coordinates' steps: 1 faces, 3 corners. */
  template <typename TVisit>
  void
  VisitAround(std::size_t voxel, int steps, const TVisit & visit) const
  {
    const VoxelPlace at = At(voxel);
    for (int k = 0; k < 27; ++k)
    {
      const VoxelPlace step{ k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1 };
      const int        length = std::abs(step[0]) + std::abs(step[1]) + std::abs(step[2]);
      if (length == 0 || length > steps)
      {
        continue;
      }
      const VoxelPlace next{ at[0] + step[0], at[1] + step[1], at[2] + step[2] };
      bool             isIn = true;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        isIn = isIn && next[axis] >= 0 && next[axis] < m_Grey.size[axis];
      }
      if (isIn)
      {
        visit((static_cast<std::size_t>(next[2]) * static_cast<std::size_t>(m_Grey.size[1]) +
               static_cast<std::size_t>(next[1])) *
                static_cast<std::size_t>(m_Grey.size[0]) +
              static_cast<std::size_t>(next[0]));
      }
    }
  }

private:
  const GreyCase & m_Grey;
};

/** The least sum of weights of voxels that part `from` from `to` over faces, among voxels with `weight` above 0 (Dinic
 *  1970, each voxel an edge from its way in to its way out). */
class VertexCut
{
public:
  VertexCut(const GreyGrid &                   grid,
            const std::vector<char> &          from,
            const std::vector<char> &          to,
            const std::vector<std::uint64_t> & weight)
  {
    const std::size_t count = grid.Count();
    m_Source = 2 * count;
    m_Sink = m_Source + 1;
    m_First.assign(m_Sink + 1, kNone);
    for (std::size_t voxel = 0; voxel < count; ++voxel)
    {
      const bool isEnd = from[voxel] != 0 || to[voxel] != 0;
      if (!isEnd && weight[voxel] == 0)
      {
        continue;
      }
      Add(2 * voxel, 2 * voxel + 1, isEnd ? kLots : weight[voxel]);
      if (from[voxel] != 0)
      {
        Add(m_Source, 2 * voxel, kLots);
      }
      if (to[voxel] != 0)
      {
        Add(2 * voxel + 1, m_Sink, kLots);
      }
      grid.VisitAround(voxel, 1, [&](std::size_t other) {
        if (from[other] != 0 || to[other] != 0 || weight[other] > 0)
        {
          Add(2 * voxel + 1, 2 * other, kLots);
        }
      });
    }
  }

  std::uint64_t
  Run()
  {
    std::uint64_t flow = 0;
    while (Level())
    {
      m_Now = m_First;
      for (std::uint64_t more = Push(m_Source, kLots); more > 0; more = Push(m_Source, kLots))
      {
        flow += more;
      }
    }
    return flow;
  }

private:
  static constexpr std::size_t   kNone = std::numeric_limits<std::size_t>::max();
  static constexpr std::uint64_t kLots = std::uint64_t{ 1 } << 50;

  struct Arc
  {
    std::size_t   to;
    std::size_t   next;
    std::uint64_t room;
  };

  void
  Add(std::size_t from, std::size_t to, std::uint64_t room)
  {
    m_Arcs.push_back({ to, m_First[from], room });
    m_First[from] = m_Arcs.size() - 1;
    m_Arcs.push_back({ from, m_First[to], 0 });
    m_First[to] = m_Arcs.size() - 1;
  }

  bool
  Level()
  {
    m_Level.assign(m_First.size(), kNone);
    m_Level[m_Source] = 0;
    std::queue<std::size_t> waiting({ m_Source });
    for (; !waiting.empty(); waiting.pop())
    {
      const std::size_t node = waiting.front();
      for (std::size_t arc = m_First[node]; arc != kNone; arc = m_Arcs[arc].next)
      {
        if (m_Arcs[arc].room > 0 && m_Level[m_Arcs[arc].to] == kNone)
        {
          m_Level[m_Arcs[arc].to] = m_Level[node] + 1;
          waiting.push(m_Arcs[arc].to);
        }
      }
    }
    return m_Level[m_Sink] != kNone;
  }

  std::uint64_t
  Push(std::size_t node, std::uint64_t most)
  {
    if (node == m_Sink)
    {
      return most;
    }
    for (std::size_t & arc = m_Now[node]; arc != kNone; arc = m_Arcs[arc].next)
    {
      Arc & one = m_Arcs[arc];
      if (one.room > 0 && m_Level[one.to] == m_Level[node] + 1)
      {
        const std::uint64_t done = Push(one.to, std::min(most, one.room));
        if (done > 0)
        {
          one.room -= done;
          m_Arcs[arc ^ 1U].room += done;
          return done;
        }
      }
    }
    return 0;
  }

  std::size_t              m_Source = 0;
  std::size_t              m_Sink = 0;
  std::vector<Arc>         m_Arcs;
  std::vector<std::size_t> m_First;
  std::vector<std::size_t> m_Now;
  std::vector<std::size_t> m_Level;
};

struct CheapWay
{
  std::uint64_t            cost = std::numeric_limits<std::uint64_t>::max();
  std::vector<std::size_t> voxels; ///< between its ends
};

/** The least sum of weights over voxels with a weight above 0 on a way from `from` to `to`, which weigh nothing. */
inline CheapWay
CheapestWay(const GreyGrid &                   grid,
            const std::vector<char> &          from,
            const std::vector<char> &          to,
            const std::vector<std::uint64_t> & weight,
            int                                steps)
{
  using Waiting = std::pair<std::uint64_t, std::size_t>;
  std::vector<std::uint64_t> way(grid.Count(), std::numeric_limits<std::uint64_t>::max());
  std::vector<std::size_t>   last(grid.Count(), 0);
  std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> waiting;
  for (std::size_t voxel = 0; voxel < grid.Count(); ++voxel)
  {
    if (from[voxel] != 0)
    {
      way[voxel] = 0;
      waiting.emplace(0, voxel);
    }
  }
  while (!waiting.empty())
  {
    const auto cost = waiting.top().first;
    const auto voxel = waiting.top().second;
    waiting.pop();
    if (to[voxel] != 0)
    {
      CheapWay result{ cost, {} };
      for (std::size_t at = last[voxel]; from[at] == 0; at = last[at])
      {
        result.voxels.push_back(at);
      }
      return result;
    }
    if (cost == way[voxel])
    {
      grid.VisitAround(voxel, steps, [&](std::size_t other) {
        const bool isOpen = to[other] != 0 || weight[other] > 0;
        const auto next = cost + (to[other] != 0 ? 0 : weight[other]);
        if (isOpen && next < way[other])
        {
          way[other] = next;
          last[other] = voxel;
          waiting.emplace(next, other);
        }
      });
    }
  }
  return {};
}

} // namespace voxelcore::testing
