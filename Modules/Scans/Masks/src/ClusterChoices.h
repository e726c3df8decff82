#pragma once
// Which candidates of one cluster are in: the cheapest choice found for each change of the numbers of pieces, loops and
// cavities.

#include "CandidateClusters.h"
#include "CandidateGraph.h"

#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/Progress.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <utility>
#include <vector>

namespace voxelcore
{

inline TopologyShift
Sum(const TopologyShift & a, const TopologyShift & b)
{
  return { a[0] + b[0], a[1] + b[1], a[2] + b[2] };
}

inline TopologyShift
Less(const TopologyShift & a, const TopologyShift & b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

inline std::int64_t
Distance(const TopologyShift & a, const TopologyShift & b)
{
  return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]);
}

/** How bad a choice is: by its numbers, then by its cost. */
using Badness = std::pair<std::int64_t, std::uint64_t>;

struct ClusterOption
{
  std::uint64_t     cost = 0;
  std::vector<char> isIn;
};
/** The cheapest way to each shift of a cluster's numbers that was found. */
using ClusterOptions = std::map<TopologyShift, ClusterOption>;

/** The choices of one cluster. */
class ClusterChoices
{
public:
  ClusterChoices(const CandidateGraph & graph, const CandidateCluster & cluster)
    : m_Graph(graph)
    , m_Cluster(cluster)
    , m_Numbers(cluster)
    , m_IsIn(cluster.candidates.size())
  {
    AsItIs();
    m_Base = m_Numbers(m_IsIn);
    Look();
  }

  void
  All()
  {
    const std::size_t count = m_IsIn.size();
    for (std::uint64_t code = 0; code < std::uint64_t{ 1 } << count; ++code)
    {
      for (std::size_t i = 0; i < count; ++i)
      {
        m_IsIn[i] = static_cast<char>(code >> i & 1U);
      }
      Look();
    }
  }

  /** From the shape as it is, all choices of a few neighbours at a time, as long as one is better; and from the shape
   *  with every cut and no fill, where its numbers are better than what that leads to: what has grown by simple voxels
   *  has no loop, and a wall in many pieces is cut only as a whole. */
  template <typename TBadness>
  void
  Windows(const TBadness & badness, const ProgressCallback & progress)
  {
    AsItIs();
    const auto least = Search(badness, progress);
    ranges::fill(m_IsIn, char{ 0 });
    if (badness(Look(), Cost()).first < least.first)
    {
      Search(badness, progress);
    }
  }

  ClusterOptions
  Release()
  {
    return std::move(m_Options);
  }

private:
  static constexpr std::size_t kWindow = 8; // candidates looked at together
  static constexpr std::size_t kMostWork = 2000000000;

  /** From the choice that is set; gives the least badness. */
  template <typename TBadness>
  auto
  Search(const TBadness & badness, const ProgressCallback & progress)
  {
    const auto        neighbours = Neighbours();
    const std::size_t count = m_IsIn.size();
    std::size_t       work = 0;
    const std::size_t cost =
      count + m_Cluster.objectEdges.size() + m_Cluster.backgroundEdges.size() + m_Cluster.terms.size();
    auto best = badness(Less(m_Numbers(m_IsIn), m_Base), Cost());
    for (bool isBetter = true; isBetter;)
    {
      isBetter = false;
      for (std::size_t seed = 0; seed < count; ++seed)
      {
        ReportProgress(progress, "simplifying", 0.5);
        // Great clusters get smaller windows, and the greatest single flips.
        const std::size_t most = work < kMostWork / 4 ? kWindow : work < kMostWork / 2 ? 3 : work < kMostWork ? 1 : 0;
        const auto        window = WindowAround(seed, most, neighbours);
        const auto        before = m_IsIn;
        auto              chosen = m_IsIn;
        for (std::size_t code = 1; code < std::size_t{ 1 } << window.size(); ++code)
        {
          for (std::size_t i = 0; i < window.size(); ++i)
          {
            m_IsIn[window[i]] = static_cast<char>(before[window[i]] ^ static_cast<char>(code >> i & 1U));
          }
          const auto found = badness(Look(), Cost());
          if (found < best)
          {
            best = found;
            chosen = m_IsIn;
            isBetter = true;
          }
        }
        work += cost << window.size();
        m_IsIn = chosen;
      }
    }
    return best;
  }

  void
  AsItIs()
  {
    for (std::size_t i = 0; i < m_IsIn.size(); ++i)
    {
      m_IsIn[i] = !m_Graph.candidates[m_Cluster.candidates[i]].isFill;
    }
  }

  std::uint64_t
  Cost() const
  {
    std::uint64_t cost = 0;
    for (std::size_t i = 0; i < m_IsIn.size(); ++i)
    {
      const auto & candidate = m_Graph.candidates[m_Cluster.candidates[i]];
      cost += (m_IsIn[i] != 0) == candidate.isFill ? candidate.cost : 0;
    }
    return cost;
  }

  TopologyShift
  Look()
  {
    const TopologyShift shift = Less(m_Numbers(m_IsIn), m_Base);
    const std::uint64_t cost = Cost();
    const auto [at, isNew] = m_Options.try_emplace(shift);
    if (isNew || cost < at->second.cost)
    {
      at->second = { cost, m_IsIn };
    }
    return shift;
  }

  /** Candidates that touch, or touch the same part. */
  std::vector<std::vector<std::uint32_t>>
  Neighbours() const
  {
    const std::size_t                       count = m_IsIn.size();
    std::vector<std::vector<std::uint32_t>> result(count);
    for (const auto * edges : { &m_Cluster.objectEdges, &m_Cluster.backgroundEdges })
    {
      std::map<std::uint32_t, std::uint32_t> lastAt;
      for (const auto & [a, b] : *edges)
      {
        std::uint32_t other = b;
        if (b >= count)
        {
          const auto [last, isNew] = lastAt.try_emplace(b, a);
          other = std::exchange(last->second, a);
          if (isNew)
          {
            continue;
          }
        }
        result[a].push_back(other);
        result[other].push_back(a);
      }
    }
    return result;
  }

  static std::vector<std::uint32_t>
  WindowAround(std::size_t seed, std::size_t most, const std::vector<std::vector<std::uint32_t>> & neighbours)
  {
    std::vector<std::uint32_t> window;
    if (most > 0)
    {
      window.push_back(static_cast<std::uint32_t>(seed));
    }
    for (std::size_t i = 0; i < window.size(); ++i)
    {
      for (const std::uint32_t other : neighbours[window[i]])
      {
        if (window.size() < most && ranges::find(window, other) == window.end())
        {
          window.push_back(other);
        }
      }
    }
    return window;
  }

  const CandidateGraph &   m_Graph;
  const CandidateCluster & m_Cluster;
  ClusterNumbers           m_Numbers;
  std::vector<char>        m_IsIn;
  TopologyShift            m_Base{};
  ClusterOptions           m_Options;
};

} // namespace voxelcore
