#include "CombinedOptions.h"

#include "voxelcore/Base/Library.h"

#include <algorithm>
#include <map>
#include <utility>

namespace voxelcore
{

namespace
{

constexpr std::size_t kMostStates = 20000;

/** One option of each cluster, so that their sum is nearest to `wanted`, then cheapest; none where there
 *  are too many combinations. */
std::vector<const ClusterOption *>
CombineExactly(const std::vector<ClusterOptions> & all, const TopologyShift & wanted)
{
  struct State
  {
    std::uint64_t         cost = 0;
    TopologyShift         from{};
    const ClusterOption * option = nullptr;
  };
  std::vector<std::map<TopologyShift, State>> states{ { { TopologyShift{}, State{} } } };
  std::size_t                                 total = 0;
  for (const ClusterOptions & options : all)
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
  const auto                         best = ranges::min_element(states.back(), {}, [&](const auto & item) {
    return Badness(Distance(item.first, wanted), item.second.cost);
  });
  std::vector<const ClusterOption *> chosen(all.size());
  TopologyShift                      sum = best->first;
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
std::vector<const ClusterOption *>
CombineGreedily(const std::vector<ClusterOptions> & all, const TopologyShift & wanted)
{
  using Choice = ClusterOptions::const_iterator;
  std::vector<Choice> chosen;
  chosen.reserve(all.size());
  for (const ClusterOptions & options : all)
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
  std::vector<const ClusterOption *> result;
  result.reserve(chosen.size());
  for (const Choice & choice : chosen)
  {
    result.push_back(&choice->second);
  }
  return result;
}

} // namespace

std::vector<const ClusterOption *>
CombineTowards(const std::vector<ClusterOptions> & all, const TopologyShift & wanted)
{
  const auto chosen = CombineExactly(all, wanted);
  return chosen.size() == all.size() ? chosen : CombineGreedily(all, wanted);
}

std::vector<const ClusterOption *>
CombineFewest(const std::vector<ClusterOptions> & all)
{
  std::vector<const ClusterOption *> chosen;
  for (const ClusterOptions & options : all)
  {
    const auto best = ranges::min_element(options, {}, [](const auto & item) {
      return Badness(item.first[0] + item.first[1] + item.first[2], item.second.cost);
    });
    chosen.push_back(&best->second);
  }
  return chosen;
}

} // namespace voxelcore
