#include "CandidateChoice.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <utility>

namespace voxelcore
{

namespace
{

constexpr std::size_t kAllChoices = 12; // candidates of a cluster for which all choices are looked at
constexpr std::size_t kWindow = 8;      // candidates looked at together in greater clusters
constexpr std::size_t kMostStates = 20000;

struct Option
{
  std::uint64_t     cost = 0;
  std::vector<char> isIn;
};
/** The cheapest way to each shift of a cluster's numbers that was found. */
using Options = std::map<TopologyShift, Option>;

TopologyShift
Sum(const TopologyShift & a, const TopologyShift & b)
{
  return { a[0] + b[0], a[1] + b[1], a[2] + b[2] };
}

TopologyShift
Less(const TopologyShift & a, const TopologyShift & b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

std::int64_t
Distance(const TopologyShift & a, const TopologyShift & b)
{
  return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]);
}

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
    std::ranges::fill(m_IsIn, char{ 0 });
    if (badness(Look(), Cost()).first < least.first)
    {
      Search(badness, progress);
    }
  }

  Options
  Release()
  {
    return std::move(m_Options);
  }

private:
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
        if (window.size() < most && std::ranges::find(window, other) == window.end())
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
  Options                  m_Options;
};

using Badness = std::pair<std::int64_t, std::uint64_t>;

/** One option of each cluster, so that their sum is nearest to `wanted`, then cheapest. */
std::vector<const Option *>
CombineExactly(const std::vector<Options> & all, const TopologyShift & wanted)
{
  struct State
  {
    std::uint64_t  cost = 0;
    TopologyShift  from{};
    const Option * option = nullptr;
  };
  std::vector<std::map<TopologyShift, State>> states{ { { TopologyShift{}, State{} } } };
  std::size_t                                 total = 0;
  for (const Options & options : all)
  {
    std::map<TopologyShift, State> next;
    for (const auto & [sum, state] : states.back())
    {
      for (const auto & [shift, option] : options)
      {
        const auto [at, isNew] = next.try_emplace(Sum(sum, shift));
        if (isNew || state.cost + option.cost < at->second.cost)
        {
          at->second = { state.cost + option.cost, sum, &option };
        }
      }
    }
    total += next.size();
    if (next.size() > kMostStates || total > 100 * kMostStates)
    {
      return {};
    }
    states.push_back(std::move(next));
  }
  const auto                  best = std::ranges::min_element(states.back(), {}, [&](const auto & item) {
    return Badness(Distance(item.first, wanted), item.second.cost);
  });
  std::vector<const Option *> chosen(all.size());
  TopologyShift               sum = best->first;
  for (std::size_t i = all.size(); i-- > 0;)
  {
    const State & state = states[i + 1].at(sum);
    chosen[i] = state.option;
    sum = state.from;
  }
  return chosen;
}

/** The same step by step: always the exchange of one cluster's option that brings the sum nearer at the least cost per
 *  number, then those that save cost. */
std::vector<const Option *>
CombineGreedily(const std::vector<Options> & all, const TopologyShift & wanted)
{
  using Choice = Options::const_iterator;
  std::vector<Choice> chosen;
  for (const Options & options : all)
  {
    chosen.push_back(options.find(TopologyShift{}));
  }
  TopologyShift sum{};
  for (;;)
  {
    double      best = 0;
    bool        isFound = false;
    std::size_t where = 0;
    Choice      how;
    const auto  far = Distance(sum, wanted);
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      for (auto at = all[i].begin(); at != all[i].end(); ++at)
      {
        const auto   gain = far - Distance(Sum(sum, Less(at->first, chosen[i]->first)), wanted);
        const double price = static_cast<double>(at->second.cost) - static_cast<double>(chosen[i]->second.cost);
        const double rate = gain > 0 ? price / static_cast<double>(gain) : 0;
        if ((gain > 0 && (!isFound || rate < best)) || (gain == 0 && price < 0 && !isFound))
        {
          isFound = true;
          best = gain > 0 ? rate : price;
          where = i;
          how = at;
        }
      }
    }
    if (!isFound)
    {
      break;
    }
    sum = Sum(sum, Less(how->first, chosen[where]->first));
    chosen[where] = how;
  }
  std::vector<const Option *> result;
  for (const Choice & choice : chosen)
  {
    result.push_back(&choice->second);
  }
  return result;
}

/** Of each cluster the option with the fewest pieces, loops and cavities, then the cheapest. */
std::vector<const Option *>
CombineFewest(const std::vector<Options> & all)
{
  std::vector<const Option *> chosen;
  for (const Options & options : all)
  {
    const auto best = std::ranges::min_element(options, {}, [](const auto & item) {
      return Badness(item.first[0] + item.first[1] + item.first[2], item.second.cost);
    });
    chosen.push_back(&best->second);
  }
  return chosen;
}

} // namespace

CandidateChoice
ChooseCandidates(const CandidateGraph &   graph,
                 const TopologyShift &    before,
                 const TopologyRequest &  request,
                 const ProgressCallback & progress)
{
  const std::vector<CandidateCluster> clusters = FindClusters(graph);
  const TopologyShift                 wanted{ request.pieces.value_or(before[0]) - before[0],
                              request.loops.value_or(before[1]) - before[1],
                              request.cavities.value_or(before[2]) - before[2] };
  std::vector<Options>                all;
  for (const CandidateCluster & cluster : clusters)
  {
    ReportProgress(progress, "simplifying", 0.5);
    ClusterChoices choices(graph, cluster);
    if (cluster.candidates.size() <= kAllChoices)
    {
      choices.All();
    }
    else
    {
      choices.Windows([](const TopologyShift & s, std::uint64_t cost) { return Badness(s[0] + s[1] + s[2], cost); },
                      progress);
      if (request.IsGiven())
      {
        choices.Windows([&](const TopologyShift & s, std::uint64_t cost) { return Badness(Distance(s, wanted), cost); },
                        progress);
      }
    }
    all.push_back(choices.Release());
  }
  auto chosen = request.IsGiven() ? CombineExactly(all, wanted) : CombineFewest(all);
  if (chosen.size() != all.size())
  {
    chosen = CombineGreedily(all, wanted);
  }
  CandidateChoice result{ std::vector<char>(graph.candidates.size()), {} };
  for (std::size_t i = 0; i < clusters.size(); ++i)
  {
    const CandidateCluster & cluster = clusters[i];
    ClusterNumbers           numbers(cluster);
    std::vector<char>        isIn(cluster.candidates.size());
    for (std::size_t k = 0; k < isIn.size(); ++k)
    {
      isIn[k] = !graph.candidates[cluster.candidates[k]].isFill;
      result.isIn[cluster.candidates[k]] = chosen[i]->isIn[k];
    }
    result.shift = Sum(result.shift, Less(numbers(chosen[i]->isIn), numbers(isIn)));
  }
  return result;
}

std::vector<TopologyShift>
GroupDifferences(const CandidateGraph &             graph,
                 const CandidateChoice &            choice,
                 const std::vector<std::uint32_t> & group,
                 std::size_t                        groups)
{
  std::vector<TopologyShift> result(groups, TopologyShift{ 0, 0, 0 });
  for (const CandidateCluster & cluster : FindClusters(graph))
  {
    ClusterNumbers                                    numbers(cluster);
    std::vector<char>                                 isIn;
    std::map<std::uint32_t, std::vector<std::size_t>> members;
    for (std::size_t k = 0; k < cluster.candidates.size(); ++k)
    {
      isIn.push_back(choice.isIn[cluster.candidates[k]]);
      if (group[cluster.candidates[k]] != kNoCandidate)
      {
        members[group[cluster.candidates[k]]].push_back(k);
      }
    }
    const TopologyShift now = numbers(isIn);
    for (const auto & [which, who] : members)
    {
      auto without = isIn;
      for (const std::size_t k : who)
      {
        without[k] = static_cast<char>(1 - without[k]);
      }
      result[which] = Sum(result[which], Less(now, numbers(without)));
    }
  }
  return result;
}

} // namespace voxelcore
